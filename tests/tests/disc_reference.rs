//! Pictures of a disc against many integrated rays per pixel.

use lensbake_render::disc::Disc;
use lensbake_render::sky::{self, SkySource};
use lensbake_studies::reference::{DrawnBy, disc_cases, disc_study};
use pollster::block_on;
use std::sync::Arc;

/// What `viewer reference --disc` measures, on the CPU, in small pictures with 36 rays per pixel.
#[test]
fn the_filtered_disc_is_the_mean_of_many_rays() {
    let sky = Arc::new(sky::load(&SkySource::Nebula).unwrap());
    let mut measured = 0;
    for case in disc_cases(&Disc::default(), 96, 54) {
        let name = case.name.clone();
        if !["60°", "89°", "90°"].iter().any(|end| name.ends_with(end)) {
            continue;
        }
        let study = block_on(disc_study(None, &sky, case, 6, || ())).unwrap();
        let picture = |by| {
            study
                .pictures
                .iter()
                .find(|picture| picture.by == by)
                .unwrap()
        };
        let filtered = picture(DrawnBy::FilteredOnCpu);
        let single = picture(DrawnBy::SingleOnCpu);
        let at = format!("{name}: {:?} {:?}", filtered.error, filtered.on_rims);
        assert!(filtered.error.whole.screen < 2.0, "{at}");
        assert!(
            2.0 * filtered.error.whole.screen < single.error.whole.screen,
            "{at}"
        );
        assert!(
            2.0 * filtered.on_rims.screen < single.on_rims.screen,
            "{at}"
        );
        measured += 1;
    }
    assert_eq!(measured, 12);
}
