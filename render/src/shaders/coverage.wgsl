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

// Images of a disc that crowd together beside the edge of the shadow: the share of the patch in which the phase, up to half
// turns, is from `low` to `high`, and the phase in the middle of the image that takes most of it. The patch sees them at the
// distances `middle` ± `half` from that edge; the phase is `phase` in the middle and grows by −`growth` with the logarithm of
// the distance.
fn crowded_share(middle: f32, half: f32, phase: f32, growth: f32, low: f32, high: f32) -> vec2<f32> {
    let first = max(middle - half, 0.0);
    let last = middle + half;
    let lowest = floor((phase - growth * log(last / middle)) / HALF_TURN) * HALF_TURN;
    // From one image order to the next, distances shrink by the same factor.
    let shrinks = exp(-HALF_TURN / growth);
    var near = middle * exp((phase - high - lowest) / growth);
    var far = middle * exp((phase - low - lowest) / growth);
    var sum = 0.0;
    var largest = 0.0;
    var seen = vec2(last, lowest);
    for (var order = 0.0; order < 4.0; order += 1.0) {
        let range = clamp(vec2(near, far), vec2(first), vec2(last));
        let covered = range.y - range.x;
        sum += covered;
        seen = select(seen, vec2(0.5 * (range.x + range.y), lowest + order * HALF_TURN), covered > largest);
        largest = max(largest, covered);
        near *= shrinks;
        far *= shrinks;
    }
    return vec2(sum / (last - first), phase - growth * log(seen.x / middle) - seen.y);
}
