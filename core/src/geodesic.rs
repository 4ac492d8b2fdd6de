//! Free fall and circular orbits, by proper time. Lengths are in units of r_s, times in r_s/c.

use crate::{CoreError, R_PHOTON};

/// Proper time of the free fall (from rest at infinity) from radius `r` to the singularity: (2/3) r^{3/2}, from
/// dr/dτ = −√(1/r).
pub fn fall_time(r: f64) -> f64 {
    2.0 / 3.0 * r * r.sqrt()
}

/// The radius from which the free fall to the singularity takes the proper time `time` ≥ 0: the inverse of
/// [`fall_time`].
pub fn fall_radius(time: f64) -> f64 {
    (1.5 * time).powi(2).cbrt()
}

/// Speed of the circular orbit at `r` relative to the observer at rest: √(1/(2(r−1))).
///
/// # Errors
/// [`CoreError::NoOrbit`] unless r > 3/2, where the speed is below that of light.
pub fn orbit_speed(r: f64) -> Result<f64, CoreError> {
    check_orbit(r)?;
    Ok((0.5 / (r - 1.0)).sqrt())
}

/// Angular velocity of the circular orbit at `r` in proper time, dφ/dτ = √(1/(2r³)) / √(1 − 3/(2r)).
///
/// # Errors
/// As [`orbit_speed`].
pub fn orbit_rate(r: f64) -> Result<f64, CoreError> {
    check_orbit(r)?;
    // √(1/(2r³)) / √((2r−3)/(2r)) = 1 / (r √(2r−3)).
    Ok(1.0 / (r * (2.0 * r - 3.0).sqrt()))
}

/// dt/dτ on the circular orbit at `r`: (1 − 3/(2r))^{−1/2}.
///
/// # Errors
/// As [`orbit_speed`].
pub fn orbit_time_dilation(r: f64) -> Result<f64, CoreError> {
    check_orbit(r)?;
    Ok((2.0 * r / (2.0 * r - 3.0)).sqrt())
}

fn check_orbit(r: f64) -> Result<(), CoreError> {
    if r > R_PHOTON {
        Ok(())
    } else {
        Err(CoreError::NoOrbit(r))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rk4::{Event, Stepper, march};

    #[test]
    fn the_fall_takes_as_long_as_its_integral() {
        for (from, to) in [(3.0, 0.01), (10.0, 1.0), (1.0, 1e-3)] {
            // State: τ, r, and a spare component for the error estimate.
            let fall = |y: &[f64; 3]| [1.0, -(1.0 / y[1]).sqrt(), 0.0];
            let end = Event {
                index: 1,
                value: to,
            };
            let start = [0.0, from, 0.0];
            let end = march(&fall, start, end, Stepper::Adaptive(1e-10)).unwrap();
            let time = fall_time(from) - fall_time(to);
            assert!((end.state[0] - time).abs() < 1e-7 * time, "{from} to {to}");
            assert!((fall_radius(fall_time(from)) / from - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn the_orbit_at_three_has_half_the_speed_of_light() {
        assert_eq!(orbit_speed(3.0), Ok(0.5));
        assert!((orbit_time_dilation(3.0).unwrap() - 2f64.sqrt()).abs() < 1e-15);
        // Kepler's third law in coordinate time: Ω = √(1/(2r³)).
        for r in [1.6, 3.0, 6.0, 1e4] {
            let omega = orbit_rate(r).unwrap() / orbit_time_dilation(r).unwrap();
            assert!((omega * (2.0 * r * r * r).sqrt() - 1.0).abs() < 1e-14);
        }
        for r in [1.5, 1.0, 0.5, f64::NAN] {
            assert!(orbit_speed(r).is_err(), "{r}");
        }
    }
}
