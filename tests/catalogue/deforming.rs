//! Things that bend or walk.

use crate::assert_worse;
use crate::shot::Shot;

#[test]
fn limbs_that_swing_are_harder_than_a_body_that_glides() {
    let shots = ["walker", "walker@gliding"].map(Shot::of);
    for filter in [
        "mcguire:paper",
        "guertin:paper",
        "jump_flood:paper",
        "jump_flood:corrected",
    ] {
        let variation = [0, 1].map(|shot: usize| shots[shot].score(filter, "label_tv"));
        assert_worse(&format!("label_tv of {filter}"), variation, 0.1);
    }
}

#[test]
fn a_waving_flag_is_harder_than_a_stiff_one() {
    let shots = ["flag", "flag@stiff"].map(Shot::of);
    for filter in [
        "mcguire:paper",
        "guertin:paper",
        "jump_flood:paper",
        "jump_flood:corrected",
    ] {
        let variation = [0, 1].map(|shot: usize| shots[shot].score(filter, "label_tv"));
        assert_worse(&format!("label_tv of {filter}"), variation, 0.1);
    }
}
