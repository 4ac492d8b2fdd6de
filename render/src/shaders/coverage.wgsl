// The share of a patch that lies on one side of an edge. disc/coverage.rs is the reference in f64.

const HALF_TURN: f32 = 3.1415927;

// The share of a square patch in which a linear function is positive that has this value at the centre and changes by
// `right` and `down` across the patch.
fn positive_share(value: f32, right: f32, down: f32) -> f32 {
    let long = max(abs(right), abs(down));
    let short = min(abs(right), abs(down));
    let size = abs(value);
    let reach = 0.5 * (long + short);
    // Beyond the first corner the edge cuts off a triangle.
    let triangle = reach - size;
    var larger = select(
        0.5 + size / max(long, 1e-30),
        1.0 - triangle * triangle / max(2.0 * long * short, 1e-30),
        2.0 * size > long - short,
    );
    larger = select(larger, 1.0, size >= reach);
    return select(1.0 - larger, larger, value >= 0.0);
}

fn periodic_integral(at: f32, low: f32, high: f32) -> f32 {
    let turns = floor(at / HALF_TURN);
    return turns * (high - low) + clamp(at - turns * HALF_TURN - low, 0.0, high - low);
}

// The mean over an interval of phases of `width` around `middle` of a function with period π that is 1 from `low` to
// `high` and 0 elsewhere.
fn periodic_share(middle: f32, width: f32, low: f32, high: f32) -> f32 {
    let below = periodic_integral(middle - 0.5 * width, low, high);
    let above = periodic_integral(middle + 0.5 * width, low, high);
    return clamp((above - below) / width, 0.0, 1.0);
}
