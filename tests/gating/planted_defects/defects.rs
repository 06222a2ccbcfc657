//! Planted defects: one wrong line of a kernel each.
//!
//! The jump flood without its break at the picture's border is not in the list. Its taps beyond the border repeat the
//! border's colours. On `frame_edge` that is a little nearer to the truth (0.95 times the mean squared error, at
//! 160x90). On other scenes the error is at most 1.02 times as large, so that this break cannot matter.

/// A defect of one shipped filter.
pub struct Defect {
    /// Name of the defect.
    pub name: &'static str,
    /// Name of the filter.
    pub filter: &'static str,
    /// Preset with bounds.
    pub preset: &'static str,
    /// Text that the kernels contain once.
    pub sound: &'static str,
    /// Text that replaces it.
    pub broken: &'static str,
}

const fn mcguire(name: &'static str, sound: &'static str, broken: &'static str) -> Defect {
    Defect {
        name,
        filter: "mcguire",
        preset: "paper",
        sound,
        broken,
    }
}

const fn jump_flood(name: &'static str, sound: &'static str, broken: &'static str) -> Defect {
    Defect {
        name,
        filter: "jump_flood",
        preset: "corrected",
        sound,
        broken,
    }
}

/// Every defect.
pub const DEFECTS: [Defect; 29] = [
    mcguire(
        "taps_ahead_only",
        "2.0 * along - 1.0;",
        "2.0 * along - 1.0 + 1.0;",
    ),
    mcguire(
        "taps_on_one_side",
        "select(along.even, along.odd, i % 2 == 1) * tap_position(i, shift)",
        "select(along.even, along.odd, i % 2 == 1) * abs(tap_position(i, shift))",
    ),
    mcguire(
        "taps_half_as_far",
        "return 2.0 * along - 1.0;",
        "return along - 0.5;",
    ),
    mcguire(
        "taps_twice_as_far",
        "return 2.0 * along - 1.0;",
        "return 4.0 * along - 2.0;",
    ),
    mcguire(
        "depth_comparison_reversed",
        "saturate(1.0 - (other - own) / parameters.soft_extent)",
        "saturate(1.0 - (own - other) / parameters.soft_extent)",
    ),
    mcguire(
        "background_dropped",
        "over + behind + 2.0 * both",
        "over + 2.0 * both",
    ),
    mcguire(
        "foreground_dropped",
        "over + behind + 2.0 * both",
        "behind + 2.0 * both",
    ),
    mcguire(
        "both_smeared_dropped",
        "over + behind + 2.0 * both",
        "over + behind",
    ),
    mcguire(
        "tile_off_by_one",
        "pixel / parameters.tile_size, 0).xyz",
        "min(pixel / parameters.tile_size + 1, tile_count() - 1), 0).xyz",
    ),
    mcguire(
        "neighbouring_columns_of_tiles_dropped",
        "for (var x = -1; x <= 1; x++) {",
        "for (var x = 0; x <= 0; x++) {",
    ),
    mcguire(
        "centre_dropped",
        "var total = parameters.center_weight / max(own_radius, 0.5);",
        "var total = 0.0;",
    ),
    mcguire(
        "centre_counts_20_times",
        "var total = parameters.center_weight / max(own_radius, 0.5);",
        "var total = parameters.center_weight * 20.0;",
    ),
    mcguire(
        "axes_swapped",
        "let half = half_velocity(textureLoad(velocity, pixel, 0).xy);",
        "let half = half_velocity(textureLoad(velocity, pixel, 0).yx);",
    ),
    mcguire(
        "y_axis_flipped",
        "let half = half_velocity(textureLoad(velocity, pixel, 0).xy);",
        "let half = half_velocity(textureLoad(velocity, pixel, 0).xy * vec2<f32>(1.0, -1.0));",
    ),
    mcguire(
        "exposure_ignored",
        "0.5 * frame.exposure * full",
        "0.5 * full",
    ),
    mcguire(
        "weights_sum_to_more_than_1",
        "textureStore(output, pixel, mean);\n}",
        "textureStore(output, pixel, mean * 1.05);\n}",
    ),
    jump_flood(
        "sign_of_the_trail_flipped",
        "let trail = motion *",
        "let trail = -motion *",
    ),
    jump_flood(
        "trail_half_as_long",
        "let trail = motion * within_reach(trail_frames(), motion, reaches);",
        "let trail = 0.5 * motion * within_reach(trail_frames(), motion, reaches);",
    ),
    jump_flood(
        "kernel_one_sided",
        "let neighbour = pixel + step * kernel[i];",
        "let neighbour = pixel + step * abs(kernel[i]);",
    ),
    jump_flood(
        "kernel_centre_dropped",
        "var i = select(1, 0, parameters.kernel == KERNEL_WITH_CENTRE); i < 9",
        "var i = 1; i < 9",
    ),
    jump_flood(
        "farther_source_wins",
        "candidate.depth < best.depth",
        "candidate.depth > best.depth",
    ),
    jump_flood(
        "sources_behind_the_pixel_kept",
        "depth_at(here) < best.depth",
        "depth_at(here) > best.depth",
    ),
    jump_flood(
        "steps_not_halved",
        "(1 << (frame.iterations - 1u - frame.iteration))",
        "(1 << (frame.iterations - 1u))",
    ),
    jump_flood(
        "sources_beyond_the_trail_kept",
        "return Fitness(along, depth_at(source), on_trail && on_path);",
        "return Fitness(along, depth_at(source), on_path);",
    ),
    jump_flood(
        "sources_beside_the_path_kept",
        "return Fitness(along, depth_at(source), on_trail && on_path);",
        "return Fitness(along, depth_at(source), on_trail);",
    ),
    jump_flood(
        "way_back_finds_nothing",
        "<= parameters.match_threshold",
        "<= -1.0",
    ),
    jump_flood(
        "weights_of_taps_ignored",
        "return 1.0 - in_front * mismatch;",
        "return 1.0;",
    ),
    jump_flood(
        "taps_off_by_a_pixel_and_a_half",
        "let position = centre(pixel) + trail * tap_position(i, pixel);",
        "let position = centre(pixel) + 1.5 + trail * tap_position(i, pixel);",
    ),
    jump_flood(
        "half_of_the_taps_dropped",
        "i < parameters.samples; i++",
        "i < parameters.samples / 2; i++",
    ),
];
