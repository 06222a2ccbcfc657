//! Forms in which engines provide a frame: sizes of buffers, samples, jitter, scale.

use frame::read_exr;
use measure::{BufferSize, CameraJitter, Case, DepthOfField, Multisampling, RenderScale, Sequence};

use crate::comparison::find_case;
use crate::sandbox::{SCENE, Sandbox};

/// Measures how far right the middle of the plate is in the output of one frame of a sequence, in
/// pixels.
fn plate_middle(sandbox: &Sandbox, sequence: &Sequence, frame: usize) -> f64 {
    let folder = sandbox.path("out").join(&sequence.frames[frame].folder);
    let output = read_exr(&folder.join("output.exr")).unwrap();
    let plate = output.plane("coverage.plate").unwrap();
    let columns = plate.pixels.iter().enumerate().map(|(at, share)| {
        let column = at % plate.width as usize;
        (column as f64 * f64::from(*share), f64::from(*share))
    });
    let (sum, area) = columns.fold((0.0, 0.0), |all, column| {
        (all.0 + column.0, all.1 + column.1)
    });
    sum / area
}

#[test]
fn the_jitter_of_a_sequence_goes_on_from_frame_to_frame() {
    let sandbox = Sandbox::new();
    sandbox.measure("--filters identity --frames 3 --input jitter=left_in");
    let run = sandbox.read_run();
    let find = |name: &str| {
        let sequence = run.sequences.iter().find(|sequence| sequence.name == name);
        sequence.expect("it has a sequence")
    };
    let [still, jittered] = ["identity:default", "identity:default jitter=left_in"].map(find);
    // The second to the fourth number of the Halton sequence of base 2, less a half.
    for (frame, jitter) in [-0.25, 0.25, -0.375].into_iter().enumerate() {
        let [moved, other] =
            [jittered, still].map(|sequence| plate_middle(&sandbox, sequence, frame));
        // Few samples see the edges of a plate of 3 by 3 pixels.
        let off = (moved - other - jitter).abs();
        assert!(off < 0.08, "frame {frame}: {moved} {other}");
    }
}

fn flip(cases: &[Case], name: &str) -> f64 {
    find_case(cases, name).scores.moving.flip.value().unwrap()
}

#[test]
fn buffers_samples_jitter_and_scale_change_what_filters_get() {
    assert_forms_count(&["quarter", "quarter_dilated"], &[50]);
}

#[test]
#[ignore = "prove: all sizes of buffers and pictures"]
fn all_sizes_of_buffers_and_pictures_change_what_filters_get() {
    let sizes = BufferSize::ALL.iter().skip(1).map(|size| size.name());
    assert_forms_count(&sizes.collect::<Vec<_>>(), &[50, 67]);
}

/// Checks forms of the input: some sizes of buffers in addition to the full one, and scales of the
/// picture in percent.
fn assert_forms_count(sizes: &[&str], scales: &[u32]) {
    let sandbox = Sandbox::new();
    let scaled = scales
        .iter()
        .map(|scale| format!("{scale}_blur_first,{scale}_upscale_first"));
    let printed = sandbox.measure(&format!(
        "--filters identity,velocity_gather:fine --input msaa=first,nearest,farthest \
         --input buffers=full,{} --input jitter=removed,left_in,resolved --input scale={}",
        sizes.join(","),
        scaled.collect::<Vec<_>>().join(",")
    ));
    let cases = sandbox.read_filter_cases();
    assert_eq!(cases.len(), 2 * (7 + sizes.len() + 2 * scales.len()));
    assert_buffers_count(&cases, &printed, sizes);
    assert_sizes_fit(&sandbox, &cases);
    assert_samples_and_jitter_count(&cases);
    assert_scales_count(&cases, scales);
}

/// Checks where a buffer's samples come from, and how jitter leaves them.
fn assert_samples_and_jitter_count(cases: &[Case]) {
    let unblurred = |change: &str| flip(cases, &format!("identity:default {change}"));
    let gathered = |change: &str| flip(cases, &format!("velocity_gather:fine {change}"));
    let [identity, whole] =
        ["identity:default", "velocity_gather:fine"].map(|name| flip(cases, name));

    // Colour is the same whichever sample velocity comes from; four samples are coarser than the
    // whole pixel.
    assert_eq!(unblurred("msaa=first"), unblurred("msaa=nearest"));
    assert_eq!(unblurred("msaa=first"), unblurred("msaa=farthest"));
    assert!((unblurred("msaa=first") - identity).abs() < 0.02);
    assert_ne!(gathered("msaa=nearest"), gathered("msaa=farthest"));

    // Anti-aliased colour equals the frame's; a jittered one is shifted, whatever its vectors.
    assert_eq!(unblurred("jitter=resolved"), identity);
    assert_eq!(unblurred("jitter=removed"), unblurred("jitter=left_in"));
    assert_ne!(unblurred("jitter=removed"), identity);
    assert_ne!(gathered("jitter=removed"), gathered("jitter=left_in"));
    assert_ne!(gathered("jitter=resolved"), whole);
    let other = find_case(cases, "identity:default jitter=left_in");
    assert_eq!(other.input.jitter, CameraJitter::LeftIn);
    assert_eq!(other.input.msaa, Multisampling::None);
}

/// Checks blurs of smaller pictures.
fn assert_scales_count(cases: &[Case], scales: &[u32]) {
    let unblurred = |change: &str| flip(cases, &format!("identity:default {change}"));
    let gathered = |change: &str| flip(cases, &format!("velocity_gather:fine {change}"));
    let identity = flip(cases, "identity:default");
    // Without a blur, the order of blur and upscaling does not matter.
    for scale in scales {
        let [before, after] =
            ["blur_first", "upscale_first"].map(|order| format!("scale={scale}_{order}"));
        assert!((unblurred(&before) - unblurred(&after)).abs() < 1e-6);
        assert_ne!(gathered(&before), gathered(&after));
        assert!((unblurred(&before) - identity).abs() > 1e-3);
        // The gather blurs as far in the small picture as in the whole one: it stays far from the
        // identity.
        assert!(gathered(&before) < 0.8 * unblurred(&before));
        assert!(gathered(&after) < 0.8 * unblurred(&after));
    }
}

/// Smaller buffers only change filters that read them.
fn assert_buffers_count(cases: &[Case], printed: &str, sizes: &[&str]) {
    let [identity, whole] =
        ["identity:default", "velocity_gather:fine"].map(|name| flip(cases, name));
    for size in sizes {
        let change = format!("buffers={size}");
        let same = flip(cases, &format!("identity:default {change}"));
        assert_eq!(same, identity);
        let changed = flip(cases, &format!("velocity_gather:fine {change}"));
        assert!((changed - whole).abs() > 1e-4, "{change} {changed} {whole}");
        assert!(printed.contains(&change));
    }
    let case = find_case(cases, "velocity_gather:fine buffers=quarter");
    assert_eq!(case.input.buffers, BufferSize::Quarter);
    // The plate's background is still: blocks without the plate's own motion blur less than those
    // that spread it.
    let [quarter, dilated] = ["quarter", "quarter_dilated"]
        .map(|size| flip(cases, &format!("velocity_gather:fine buffers={size}")));
    assert_ne!(quarter, dilated);
}

/// The output of a small picture has the whole picture's size, and its positions are in the whole
/// picture's pixels.
fn assert_sizes_fit(sandbox: &Sandbox, cases: &[Case]) {
    let case = find_case(cases, "velocity_gather:fine scale=50_blur_first");
    assert_eq!(case.input.scale, RenderScale::HalfBlurFirst);
    let plain = find_case(cases, "velocity_gather:fine");
    let [small, whole] = [case, plain].map(|case| {
        let output = sandbox.path("out").join(&case.folder).join("output.exr");
        let output = read_exr(&output).unwrap();
        let offset = case.scores.probes.gather_offset.value().unwrap();
        ((output.width, output.height), offset)
    });
    assert_eq!(small.0, whole.0);
    assert!((small.1 - whole.1).abs() < 0.5, "{} {}", small.1, whole.1);
    assert!(case.scores.probes.unity.value().unwrap() < 1e-3);
}

#[test]
fn depth_of_field_runs_before_a_filter_or_after_it() {
    let sandbox = Sandbox::new();
    let words = "--filters identity,velocity_gather:fine --input depth_of_field=before,after";
    let lens = SCENE.replace("vertical_fov", "aperture = 0.8\nfocus = 2\nvertical_fov");
    sandbox.write("scene.toml", &lens);
    let printed = sandbox.measure(words);
    let cases = sandbox.read_filter_cases();
    assert_eq!(cases.len(), 2 * 2);
    assert!(printed.contains("depth_of_field=after"));
    let case = |name: &str| find_case(&cases, name);
    let after = case("velocity_gather:fine depth_of_field=after");
    assert_eq!(after.input.depth_of_field, DepthOfField::After);
    let output = |name: &str| {
        let folder = sandbox.path("out").join(&case(name).folder);
        read_exr(&folder.join("output.exr")).unwrap()
    };
    // Without a blur the pass leaves the plate about as the lens shows it: the plate hides nothing
    // of a flat background.
    let [before, after] = ["", " depth_of_field=after"]
        .map(|form| output(&format!("identity:default{form}")))
        .map(|output| output.plane("coverage.plate").unwrap().pixels.clone());
    let apart = (before.iter().zip(&after)).map(|(a, b)| (a - b).abs());
    assert!(apart.fold(0.0, f32::max) < 0.25);
    let [a, b] = ["", " depth_of_field=after"]
        .map(|form| flip(&cases, &format!("velocity_gather:fine{form}")));
    assert!((a - b).abs() > 1e-4, "{a} {b}");
}
