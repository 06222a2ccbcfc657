//! Arguments on the forms in which filters get their frames.

use clap::Args;
use suite::{
    Border, BufferSize, CameraJitter, DepthFormat, DepthOfField, InputForms, Multisampling,
    RenderScale, ShutterRule, VelocityDefect, VelocityFormat,
};

use super::parse::parse_named;

/// Forms to try on every filter beside the full one.
#[derive(Clone, Debug, Args)]
pub struct InputFormArgs {
    /// Formats of the velocity buffer to try on every filter beside 32-bit floats, separated by commas.
    #[arg(help_heading = "Inputs of filters", long, value_parser = parse_named(VelocityFormat::ALL, VelocityFormat::name, VelocityFormat::help), value_delimiter = ',', value_name = "FORMATS")]
    pub velocity_format: Vec<VelocityFormat>,
    /// Defects of the velocity buffer to try on every filter beside the right one, separated by commas. They show what each costs.
    #[arg(help_heading = "Inputs of filters", long, value_parser = parse_named(VelocityDefect::ALL, VelocityDefect::name, VelocityDefect::help), value_delimiter = ',', value_name = "DEFECTS")]
    pub velocity_defect: Vec<VelocityDefect>,
    /// Formats of the depth buffer to try beside 32-bit floats, separated by commas.
    #[arg(help_heading = "Inputs of filters", long, value_parser = parse_named(DepthFormat::ALL, DepthFormat::name, DepthFormat::help), value_delimiter = ',', value_name = "FORMATS")]
    pub depth_format: Vec<DepthFormat>,
    /// Content beyond the border to try beside each filter's own, separated by commas; see also --guard-band.
    #[arg(help_heading = "Inputs of filters", long, value_parser = parse_named(Border::ALL, Border::name, Border::help), value_delimiter = ',', value_name = "POLICIES")]
    pub border: Vec<Border>,
    /// Sizes of the velocity and depth buffers to try beside the full one, separated by commas. Colour stays full.
    #[arg(help_heading = "Inputs of filters", long, value_parser = parse_named(BufferSize::ALL, BufferSize::name, BufferSize::help), value_delimiter = ',', value_name = "SIZES")]
    pub buffer_size: Vec<BufferSize>,
    /// Frames of 4 samples per pixel to try, separated by commas: which sample velocity and depth come from. Colour is the mean of all.
    #[arg(help_heading = "Inputs of filters", long, value_parser = parse_named(Multisampling::ALL, Multisampling::name, Multisampling::help), value_delimiter = ',', value_name = "SAMPLES")]
    pub msaa: Vec<Multisampling>,
    /// Frames of a jittered camera to try, as temporal anti-aliasing has it, separated by commas.
    #[arg(help_heading = "Inputs of filters", long, value_parser = parse_named(CameraJitter::ALL, CameraJitter::name, CameraJitter::help), value_delimiter = ',', value_name = "FORMS")]
    pub camera_jitter: Vec<CameraJitter>,
    /// Frames that are rendered at 50, 67 or 77 % of the picture's width and height to try, separated by commas; blurred before or
    /// after they are upscaled.
    #[arg(help_heading = "Inputs of filters", long, value_parser = parse_named(RenderScale::ALL, RenderScale::name, RenderScale::help), value_delimiter = ',', value_name = "SCALES")]
    pub render_scale: Vec<RenderScale>,
    /// Rules by which every filter sets its exposure at another frame rate to try beside the truth's exposure, separated by commas. They
    /// show what a filter costs that does not follow the shutter.
    #[arg(help_heading = "Inputs of filters", long, value_parser = parse_named(ShutterRule::ALL, ShutterRule::name, ShutterRule::help), value_delimiter = ',', value_name = "RULES")]
    pub shutter_rule: Vec<ShutterRule>,
    /// Places of depth of field to try, in scenes whose camera has a lens, separated by commas: before motion blur, or after.
    #[arg(help_heading = "Inputs of filters", long, value_parser = parse_named(DepthOfField::ALL, DepthOfField::name, DepthOfField::help), value_delimiter = ',', value_name = "PLACES")]
    pub depth_of_field: Vec<DepthOfField>,
}

impl InputFormArgs {
    /// Lists the forms part by part.
    pub fn input_forms(&self) -> InputForms {
        InputForms {
            velocity: self.velocity_format.clone(),
            depth: self.depth_format.clone(),
            border: self.border.clone(),
            defect: self.velocity_defect.clone(),
            buffers: self.buffer_size.clone(),
            msaa: self.msaa.clone(),
            jitter: self.camera_jitter.clone(),
            scale: self.render_scale.clone(),
            rule: self.shutter_rule.clone(),
            depth_of_field: self.depth_of_field.clone(),
        }
    }
}
