//! The realtime renderer's report on whether the GPU had room for all stars, from which the window's notice is
//! made.

use lensbake_render::camera::View;
use lensbake_render::gpu::{
    FrameContent, RealtimeRenderer, ResidentScene, StarLight, StarsOnDevice, Stopwatch,
};
use lensbake_render::lens::Deflection;
use lensbake_render::scene::Scene;
use lensbake_render::stars::{self, StarField};
use lensbake_tests::stars::black;
use lensbake_tests::{lens, renderer};
use pollster::block_on;
use std::time::{Duration, Instant};

/// A realtime renderer, its stopwatch, and its scene without stars.
struct RealtimeFixture {
    realtime: RealtimeRenderer,
    stopwatch: Stopwatch,
    scene: ResidentScene,
}

impl RealtimeFixture {
    fn new() -> Self {
        let view = View {
            width: 160,
            height: 90,
            ..View::default()
        };
        let renderer = renderer();
        let scene = Scene::new(lens(&view, Deflection::Lut), black());
        RealtimeFixture {
            stopwatch: Stopwatch::new(renderer.gpu()),
            scene: block_on(renderer.upload(&scene)).unwrap(),
            realtime: RealtimeRenderer::new(renderer, [160, 90]),
        }
    }

    /// The stars of Hipparcos at this exposure.
    fn stars(&self, stops: f64) -> StarsOnDevice {
        let field = StarField::new(&stars::hipparcos(), stops);
        self.realtime.renderer().upload_stars(&field)
    }

    fn draw(&mut self, stars: Option<&StarsOnDevice>) {
        self.scene.stars = stars.cloned();
        self.realtime.show(&self.scene, FrameContent::Picture);
        let gpu = self.realtime.renderer().gpu();
        self.stopwatch.submit(gpu, &self.realtime);
    }

    /// Draws a frame and waits for its report.
    fn report(&mut self, stars: &StarsOnDevice) -> StarLight {
        self.draw(Some(stars));
        let since = Instant::now();
        loop {
            self.realtime.renderer().gpu().poll().unwrap();
            if let Some(light) = self.realtime.star_light() {
                return light;
            }
            assert!(self.realtime.awaits_star_light(), "nothing is on its way");
            assert!(since.elapsed() < Duration::from_secs(60), "no word comes");
        }
    }
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn a_live_picture_tells_whether_it_has_the_light_of_all_stars() {
    let mut live = RealtimeFixture::new();
    let few = live.stars(0.0);
    for _ in 0..10 {
        assert_eq!(live.report(&few), StarLight::Whole);
        assert!(!live.realtime.awaits_star_light(), "all have come back");
    }
    // So bright that each has halos: more than two million nodes.
    let bright = live.stars(12.0);
    for _ in 0..2 {
        assert_eq!(live.report(&bright), StarLight::PartLost);
    }
    assert_eq!(live.report(&few), StarLight::Whole);
}

/// A window may draw many frames before it reads a report.
#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn frames_that_nobody_asks_about_do_no_harm() {
    let mut live = RealtimeFixture::new();
    let bright = live.stars(12.0);
    for _ in 0..6 {
        live.draw(Some(&bright));
    }
    block_on(live.realtime.renderer().gpu().wait()).unwrap();
    assert_eq!(live.report(&bright), StarLight::PartLost);
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn without_stars_there_is_nothing_to_tell() {
    let mut live = RealtimeFixture::new();
    live.draw(None);
    assert_eq!(live.realtime.star_light(), None);
    assert!(!live.realtime.awaits_star_light());
}
