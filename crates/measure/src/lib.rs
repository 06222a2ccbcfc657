//! Rendering and measuring of filters over scenes, with inputs as in engines. Nothing here prints:
//! results are data, and progress goes to a [`Monitor`].

mod colors;
mod error;
mod files;
mod filter_choice;
mod fold;
mod identity;
mod inputs;
mod measuring;
mod monitor;
mod named;
mod random;
mod render;
mod run;
mod runner;
mod score;
mod stats;
mod text;

pub use colors::{magma, velocity_wheel};
pub use error::Error;
pub use files::channels::{check_finite, check_values, find_channel, read_motion, take_velocity};
pub use files::clear::clear_scene;
pub use files::folder::{is_below, refuse_long_names, refuse_scene, scene_folder};
pub use files::folder_lock::{FolderLock, Sharing, lock_folder};
pub use files::json::{MAX_JSON_BYTES, MAX_RUN_BYTES, read_text, read_text_within};
pub use files::json_lines::to_lines;
pub use files::place::{MAX_TAKEN_BYTES, is_one_file, place_file};
pub use files::record::{
    CASE_RECORD, errors_file, hash_inputs, hash_program, look_up, look_up_alone, name_program, put,
    read_record, remove_altered_files,
};
pub use files::render_file::{
    LADDER, MAX_REPLICATES, RenderFile, RenderPath, SHARP, ladder_folder, list_files, list_renders,
};
pub use files::tracked::refuse_tracked;
pub use filter_choice::FilterChoice;
pub use fold::fold_runs;
pub use identity::{CaseId, FilterId, IDENTITY, ReferencePicture};
pub use inputs::buffer_size::BufferSize;
pub use inputs::camera_jitter::CameraJitter;
pub use inputs::depth_format::DepthFormat;
pub use inputs::depth_of_field::DepthOfField;
pub use inputs::input_format::{InputForm, InputFormat, InputKind};
pub use inputs::multisampling::Multisampling;
pub use inputs::render_scale::RenderScale;
pub use inputs::shutter_rule::ShutterRule;
pub use inputs::velocity_format::VelocityFormat;
pub use measuring::earlier::{EarlierCases, find_newer_sizes, folder_for_size};
pub use measuring::estimate::{
    RunEstimate, estimate_case_seconds, estimate_render_seconds, estimate_run,
};
pub use measuring::measured_filters::MEASURED_FILTERS;
pub use measuring::part::Part;
pub use measuring::pictures::{CASE_FILES, FRAME_FILES, truth_files};
pub use measuring::plan::RunPlan;
pub use measuring::probes::filter_input;
pub use measuring::scenes::measure_scenes;
pub use measuring::sequence::{CHANGE_PICTURE, SEQUENCE_PICTURE};
pub use monitor::{Monitor, Step};
pub use random::Random;
pub use render::exclusion::{EXCLUSION_FILE, FilterFrame, read_exclusion};
pub use render::in_memory::{MemoryRender, RenderedScene};
pub use render::ingested_scene::{
    BLURRED, Drawn, INGESTED_FORMAT, IngestedScene, NO_VELOCITY, engine_name, name_in_one_word,
};
pub use render::ladders::sharp_picture;
pub use render::rendering::Rendering;
pub use render::run_scene::RunScene;
pub use render::settings::{SIDES, list_settings};
pub use render::truths::deciding_floor;
pub use render::velocities::read_further_velocities;
pub use run::case::{Case, Intervals};
pub use run::error_maps::ErrorMaps;
pub use run::failure::{Failure, refuse_failures};
pub use run::layers::write_layers;
pub use run::overall::Overall;
pub use run::sequence::{Frames, MAX_FRAMES, Sequence, SequenceFrame, worst_frames};
pub use run::stored::StoredRun;
pub use run::{FORMAT, Run};
pub use runner::{Runner, open_adapter, open_gpu};
pub use score::convention::read_convention;
pub use score::finished_picture::{FinishedPicture, bright_note, read_finished_picture};
pub use score::numbered::{find_numbered, numbered_file};
pub use score::picture_file::{PictureFile, PictureKind, read_picture};
pub use score::reached::{LEAST_MOTION, mark_reached};
pub use score::reference::{
    ComparedPictures, Mattes, PicturePair, compare_pictures, missing_in_pair, reference_shutter,
};
pub use score::scores::{Scored, missing_scores, score, shorten_names};
pub use score::sequence::{SequenceTruth, file_at_frame, score_sequence};
pub use stats::intervals::intervals;
pub use stats::overall::{overall, rank_filters};
pub use stats::parts::{Groups, MIN_REPLICATES};
pub use stats::scene_mean::{
    MIN_SCENES, ONE_SIDED, SceneMean, TWO_SIDED, Weighted, plain_mean, scene_mean,
};
pub use text::markdown::{escape_markdown, markdown_code};
pub use text::printable::{printable, printable_lines, printable_path};

/// Program name and version, as recorded in files and runs.
pub const PROGRAM: &str = concat!("shuttertruth ", env!("CARGO_PKG_VERSION"));
