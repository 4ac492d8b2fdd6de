//! Movement along a great circle around the hole.
//!
//! With the unit vectors to the camera (p), east (e) and north (n), the heading h is the direction
//! d = e cos h + n sin h. Along the great circle by the angle a, p becomes p cos a + d sin a and d becomes
//! d cos a − p sin a. Vectors have no special place at the poles.

use super::View;
use glam::DVec3;

/// A place on the sphere around the hole and a direction there, degrees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// Longitude.
    pub longitude_deg: f64,
    /// Latitude. Beyond ±90° it is past the pole, where east and north point the other way.
    pub latitude_deg: f64,
    /// Heading, from east (growing longitude) towards north.
    pub heading_deg: f64,
}

impl Place {
    /// The place and heading of the camera of a view.
    pub fn of(view: &View) -> Self {
        Place {
            longitude_deg: view.orbit_deg,
            latitude_deg: view.latitude_deg,
            heading_deg: view.heading_deg,
        }
    }

    /// The unit vector from the hole to the place, in the sky frame.
    pub fn direction(self) -> DVec3 {
        let [place, ..] = self.axes();
        place
    }

    /// The place and heading after moving along the great circle of the heading by `angle`, rad. The latitude stays on
    /// its side of ±90°: over a pole, longitude and heading jump instead. The new angles are from −180° to 180°, the
    /// longitude to 360°.
    pub fn moved(self, angle: f64) -> Self {
        let [place, east, north] = self.axes();
        let (along_north, along_east) = self.heading_deg.to_radians().sin_cos();
        let direction = east * along_east + north * along_north;
        let (sin, cos) = angle.sin_cos();
        let (place, direction) = (place * cos + direction * sin, direction * cos - place * sin);
        let moved = Self::at(place, self.latitude_deg.to_radians().cos() < 0.0);
        let [_, east, north] = moved.axes();
        let heading = direction.dot(north).atan2(direction.dot(east));
        Place {
            heading_deg: heading.to_degrees(),
            ..moved
        }
    }

    /// The place in the direction `to`, its latitude past the pole if `beyond`, with the heading 0.
    fn at(to: DVec3, beyond: bool) -> Self {
        let longitude = to.x.atan2(to.z).to_degrees();
        let latitude = to.y.atan2(to.x.hypot(to.z)).to_degrees();
        let (longitude_deg, latitude_deg) = match beyond {
            true => (longitude + 180.0, 180f64.copysign(latitude) - latitude),
            false => (longitude, latitude),
        };
        Place {
            longitude_deg,
            latitude_deg,
            heading_deg: 0.0,
        }
    }

    /// The unit vectors to the place, east and north.
    fn axes(self) -> [DVec3; 3] {
        let (sin_lon, cos_lon) = self.longitude_deg.to_radians().sin_cos();
        let (sin_lat, cos_lat) = self.latitude_deg.to_radians().sin_cos();
        [
            DVec3::new(cos_lat * sin_lon, sin_lat, cos_lat * cos_lon),
            DVec3::new(cos_lon, 0.0, -sin_lon),
            DVec3::new(-sin_lat * sin_lon, cos_lat, -sin_lat * cos_lon),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Camera;
    use lensbake_core::Motion;
    use proptest::prelude::*;

    fn place(longitude_deg: f64, latitude_deg: f64, heading_deg: f64) -> Place {
        Place {
            longitude_deg,
            latitude_deg,
            heading_deg,
        }
    }

    #[track_caller]
    fn same(found: Place, known: Place) {
        let off = |a: f64, b: f64| {
            let turns = (a - b) / 360.0;
            360.0 * (turns - turns.round()).abs()
        };
        let worst = off(found.longitude_deg, known.longitude_deg)
            .max(off(found.latitude_deg, known.latitude_deg))
            .max(off(found.heading_deg, known.heading_deg));
        assert!(worst < 1e-12, "{found:?} {known:?}");
    }

    #[test]
    fn along_equator_and_meridian_one_angle_changes() {
        let quarter = 0.25f64.to_radians();
        same(place(10.0, 0.0, 0.0).moved(quarter), place(10.25, 0.0, 0.0));
        let west = place(10.0, 0.0, 180.0).moved(quarter);
        same(west, place(9.75, 0.0, 180.0));
        same(
            place(10.0, 20.0, 90.0).moved(quarter),
            place(10.0, 20.25, 90.0),
        );
        same(
            place(10.0, 20.0, -90.0).moved(quarter),
            place(10.0, 19.75, -90.0),
        );
    }

    #[test]
    fn over_the_pole_longitude_and_heading_turn_round() {
        let over = place(10.0, 80.0, 90.0).moved(20f64.to_radians());
        same(over, place(-170.0, 80.0, -90.0));
        // Past the pole from the start: the same place and direction are at (−160°, 70°), heading −80°.
        let beyond = place(20.0, 110.0, 100.0).moved(5f64.to_radians());
        let usual = place(-160.0, 70.0, -80.0).moved(5f64.to_radians());
        let [a, b] = [beyond, usual].map(|place| place.axes()[0]);
        assert!((a - b).length() < 1e-14 && beyond.latitude_deg > 90.0);
        let below = place(20.0, -110.0, 100.0).moved(5f64.to_radians());
        assert!(below.latitude_deg < -90.0, "{below:?}");
    }

    /// Napier's rules: from the equator with heading h, sin(latitude) = sin h sin a and cos(heading) cos(latitude)
    /// stays cos h (Clairaut).
    #[test]
    fn it_is_the_known_great_circle() {
        let heading = 50f64.to_radians();
        for angle in [0.1, 1.0, 1.5, 3.0, 6.0] {
            let moved = place(0.0, 0.0, 50.0).moved(angle);
            let latitude = moved.latitude_deg.to_radians();
            assert!((latitude.sin() - heading.sin() * angle.sin()).abs() < 1e-14);
            let kept = moved.heading_deg.to_radians().cos() * latitude.cos();
            assert!((kept - heading.cos()).abs() < 1e-14);
        }
    }

    /// The camera's position and the direction of its orbit, on the sky.
    fn camera(place: Place) -> [DVec3; 2] {
        let camera = Camera::new(&View {
            radius: 6.0,
            motion: Motion::Orbit,
            orbit_deg: place.longitude_deg,
            latitude_deg: place.latitude_deg,
            heading_deg: place.heading_deg,
            ..View::default()
        });
        let camera = camera.unwrap();
        let motion = DVec3::from_array(camera.boost.unwrap().direction);
        [DVec3::Z, motion].map(|v| camera.sky_from_hole * v)
    }

    proptest! {
        #[test]
        fn the_camera_moves_in_the_direction_of_its_boost(
            longitude in -180.0..180.0f64,
            latitude in -180.0..180.0f64,
            heading in -180.0..180.0f64,
            angle in -7.0..7.0f64,
        ) {
            let start = place(longitude, latitude, heading);
            let ([p, d], (sin, cos)) = (camera(start), angle.sin_cos());
            let [to, direction] = camera(start.moved(angle));
            prop_assert!((to - (p * cos + d * sin)).length() < 1e-13);
            prop_assert!((direction - (d * cos - p * sin)).length() < 1e-13);
        }

        #[test]
        fn many_small_steps_lead_where_one_does(
            latitude in -89.0..89.0f64,
            heading in -180.0..180.0f64,
            angle in 0.0..7.0f64,
        ) {
            let start = place(5.0, latitude, heading);
            let mut stepped = start;
            for _ in 0..1000 {
                stepped = stepped.moved(1e-3 * angle);
            }
            let ends = [stepped, start.moved(angle)].map(camera);
            prop_assert!((ends[0][0] - ends[1][0]).length() < 1e-12);
            prop_assert!((ends[0][1] - ends[1][1]).length() < 1e-12);
        }
    }
}
