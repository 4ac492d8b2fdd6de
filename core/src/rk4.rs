//! The classical Runge–Kutta method of order four, and integration with it up to an event.
//!
//! The system is autonomous: dY/dφ = F(Y), with φ itself as component Y₀. To end exactly at the event, the last
//! step takes the event's component as the independent variable, dY/dY_k = F/F_k (Hénon 1982, Physica D 5, 412).

/// How the step length is chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stepper {
    /// Constant steps of this length in φ (rad).
    Fixed(f64),
    /// Steps chosen by step doubling, so that the relative error per radian of φ stays below this tolerance.
    Adaptive(f64),
}

/// The event that ends an integration: component `index` of the state reaches `value`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event {
    /// Index of the component.
    pub index: usize,
    /// The value that the component reaches.
    pub value: f64,
}

/// The state at the event, and the cost of reaching it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EventState<const N: usize> {
    /// The state; its component `event.index` equals `event.value`.
    pub state: [f64; N],
    /// Number of evaluations of the right-hand side.
    pub evaluations: u32,
}

/// First step of an adaptive integration, rad.
const FIRST_STEP: f64 = 0.05;
/// Longest step of an adaptive integration, rad; a longer one might step over the event.
const LONGEST_STEP: f64 = 0.5;
/// Most steps of an integration. A ray that f64 can distinguish from a captured one needs fewer, at any tolerance
/// in use.
const STEP_LIMIT: u32 = 10_000_000;

/// One RK4 step of length `h` for dY/dt = `f`(Y).
pub fn step<const N: usize>(f: &impl Fn(&[f64; N]) -> [f64; N], y: &[f64; N], h: f64) -> [f64; N] {
    let at = |k: &[f64; N], h: f64| std::array::from_fn(|i| y[i] + h * k[i]);
    let k1 = f(y);
    let k2 = f(&at(&k1, 0.5 * h));
    let k3 = f(&at(&k2, 0.5 * h));
    let k4 = f(&at(&k3, h));
    std::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]))
}

/// Integrates dY/dφ = `f`(Y) from `start` until `event`. Component 0 is φ. The error is estimated from components
/// 1 and 2, the position and the velocity.
///
/// `None` if the event is not reached within the step limit or the state stops being finite.
pub fn march<const N: usize>(
    f: &impl Fn(&[f64; N]) -> [f64; N],
    start: [f64; N],
    event: Event,
    stepper: Stepper,
) -> Option<EventState<N>> {
    let mut y = start;
    let mut h = match stepper {
        Stepper::Fixed(h) => h,
        Stepper::Adaptive(_) => FIRST_STEP,
    };
    let mut evaluations = 0;
    let side = |y: &[f64; N]| event.value - y[event.index];
    let ahead = side(&y);
    if ahead == 0.0 {
        return Some(EventState {
            state: y,
            evaluations,
        });
    }
    for _ in 0..STEP_LIMIT {
        // Do not try a step that would end far beyond the event: the right-hand side may be unbounded there.
        let h_to_event = side(&y) / f(&y)[event.index];
        if (0.0..0.5 * h).contains(&h_to_event) && matches!(stepper, Stepper::Fixed(_)) {
            return Some(EventState {
                state: land(f, &y, event),
                evaluations: evaluations + 5,
            });
        }
        let trial = match stepper {
            Stepper::Fixed(_) => Trial::accepted(step(f, &y, h), h, 4),
            Stepper::Adaptive(tolerance) => doubled_step(f, &y, h, tolerance),
        };
        evaluations += trial.evaluations;
        h = trial.next_h;
        let Some(next) = trial.state else { continue };
        if !next.iter().all(|c| c.is_finite()) {
            return None;
        }
        if side(&next) * ahead <= 0.0 {
            return Some(EventState {
                state: land(f, &y, event),
                evaluations: evaluations + 4,
            });
        }
        y = next;
    }
    None
}

/// The last step, with the event's component as the independent variable.
fn land<const N: usize>(
    f: &impl Fn(&[f64; N]) -> [f64; N],
    y: &[f64; N],
    event: Event,
) -> [f64; N] {
    let swapped = |y: &[f64; N]| {
        let slope = f(y);
        std::array::from_fn(|i| slope[i] / slope[event.index])
    };
    let mut state = step(&swapped, y, event.value - y[event.index]);
    state[event.index] = event.value;
    state
}

/// An attempted step: its result if it was accurate enough, and the step length to try next.
struct Trial<const N: usize> {
    state: Option<[f64; N]>,
    next_h: f64,
    evaluations: u32,
}

impl<const N: usize> Trial<N> {
    fn accepted(state: [f64; N], next_h: f64, evaluations: u32) -> Self {
        Trial {
            state: Some(state),
            next_h,
            evaluations,
        }
    }
}

/// One step of `h` compared with two of `h/2`. Their difference gives the error estimate and, by Richardson
/// extrapolation, the correction.
fn doubled_step<const N: usize>(
    f: &impl Fn(&[f64; N]) -> [f64; N],
    y: &[f64; N],
    h: f64,
    tolerance: f64,
) -> Trial<N> {
    let whole = step(f, y, h);
    let halves = step(f, &step(f, y, 0.5 * h), 0.5 * h);
    let correction: [f64; N] = std::array::from_fn(|i| (halves[i] - whole[i]) / 15.0);
    let error = correction[1].abs() + correction[2].abs();
    let allowed = tolerance * h * (y[1].abs() + y[2].abs());
    // The error per unit of φ falls as h⁴. A NaN error shrinks the step, as a large error does.
    let growth = 0.9 * (allowed / error.max(f64::MIN_POSITIVE)).powf(0.25);
    if error <= allowed {
        let next_h = (h * growth.clamp(1.0, 4.0)).min(LONGEST_STEP);
        let state = std::array::from_fn(|i| halves[i] + correction[i]);
        Trial::accepted(state, next_h, 12)
    } else {
        let shrink = if growth.is_nan() {
            0.1
        } else {
            growth.clamp(0.1, 0.9)
        };
        Trial {
            state: None,
            next_h: h * shrink,
            evaluations: 12,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// y″ = −y from (1, 0): reaches 0 at φ = π/2.
    fn oscillator(y: &[f64; 3]) -> [f64; 3] {
        [1.0, y[2], -y[1]]
    }

    const DOWN: Event = Event {
        index: 1,
        value: 0.0,
    };

    fn quarter_turn(stepper: Stepper) -> f64 {
        march(&oscillator, [0.0, 1.0, 0.0], DOWN, stepper)
            .unwrap()
            .state[0]
            - std::f64::consts::FRAC_PI_2
    }

    #[test]
    fn fixed_steps_converge_with_order_four() {
        let (coarse, fine) = (
            quarter_turn(Stepper::Fixed(0.1)),
            quarter_turn(Stepper::Fixed(0.05)),
        );
        let order = (coarse / fine).abs().log2();
        assert!((3.5..5.5).contains(&order), "order {order}");
    }

    #[test]
    fn adaptive_steps_keep_their_tolerance() {
        for tolerance in [1e-6, 1e-9, 1e-12] {
            let error = quarter_turn(Stepper::Adaptive(tolerance)).abs();
            assert!(error < 3.0 * tolerance, "{error:e} at {tolerance:e}");
        }
    }

    #[test]
    fn an_event_at_the_start_costs_nothing() {
        let arrival = march(&oscillator, [0.0; 3], DOWN, Stepper::Fixed(0.1)).unwrap();
        assert_eq!((arrival.state, arrival.evaluations), ([0.0; 3], 0));
    }

    #[test]
    fn a_state_that_explodes_is_no_arrival() {
        let explosive = |y: &[f64; 3]| [1.0, y[1] * y[1], 0.0];
        let never = Event {
            index: 2,
            value: 1.0,
        };
        assert!(march(&explosive, [0.0, 1.0, 0.0], never, Stepper::Fixed(0.1)).is_none());
    }
}
