// The pattern on a disc. disc/pattern.rs explains it and is the reference in f64, disc/seen.rs that of the steps.
// #import arithmetic
// #import disc
// #import disc_hits

// Angular velocity of matter at r = 1/u.
fn angular_velocity(u: f32) -> f32 {
    return sqrt(0.5 * u * u * u);
}

// Mixes the bits of x as in sky/noise.rs.
fn mixed_bits(bits: u32) -> u32 {
    var x = (bits ^ (bits >> 16u)) * 0x6a09e667u;
    x = (x ^ (x >> 15u)) * 0xbb67ae85u;
    return x ^ (x >> 16u);
}

fn corner_noise(column: i32, row: i32, cells: i32, seed: u32, from_corner: vec2<f32>) -> f32 {
    let wrapped = ((row % cells) + cells) % cells;
    let bits = mixed_bits(mixed_bits(seed ^ u32(column)) + u32(wrapped));
    let slopes = vec2(f32(bits & 0xffffu), f32(bits >> 16u)) / 32767.5 - 1.0;
    return dot(slopes, from_corner);
}

// Gradient noise with cells of size 1, periodic in y after `cells` of them.
fn cloud_noise(point: vec2<f32>, cells: i32, seed: u32) -> f32 {
    let cell = floor(point);
    let within = point - cell;
    let weight = within * within * within * (within * (within * 6.0 - 15.0) + 10.0);
    let column = i32(cell.x);
    let row = i32(cell.y);
    let low = mix(
        corner_noise(column, row, cells, seed, within),
        corner_noise(column + 1, row, cells, seed, within - vec2(1.0, 0.0)),
        weight.x,
    );
    let high = mix(
        corner_noise(column, row + 1, cells, seed, within - vec2(0.0, 1.0)),
        corner_noise(column + 1, row + 1, cells, seed, within - vec2(1.0, 1.0)),
        weight.x,
    );
    return mix(low, high, weight.y);
}

// One layer at (ln r, azimuth), with the steps of those across the patch.
fn layer_of_clouds(
    at: vec2<f32>, right: vec2<f32>, down: vec2<f32>, velocity: f32, age: f32, seed: u32,
) -> f32 {
    let turned = velocity * age;
    let right_there = right + vec2(0.0, 1.5 * turned * right.x);
    let down_there = down + vec2(0.0, 1.5 * turned * down.x);
    let place = at - vec2(0.0, turned);
    var sum = 0.0;
    var strength = 1.0;
    var number = 7;
    for (var octave = 0u; octave < 4u; octave++) {
        let cells_per = vec2(0.6, 0.15915494) * f32(number);
        let size = length(right_there * cells_per) + length(down_there * cells_per);
        let visible = 1.0 - clamp((size - 0.4) / 0.8, 0.0, 1.0);
        if visible > 0.0 {
            sum += strength * visible * cloud_noise(place * cells_per, number, seed + octave);
        }
        strength *= 0.6;
        number = select(2 * number + 1, 65, octave == 2u);
    }
    return sum;
}

// The factor of the light at a crossing.
fn disc_pattern(seen: Patch, orbit: Orbit, crossing: Crossing, u: f32) -> f32 {
    let turned = cos_sin(crossing.phase);
    let sky = crossing.sky;
    let at = vec2(dot(sky, turned), sky.y * turned.x - sky.x * turned.y);
    let e = vec2(seen.tangential.y, -seen.tangential.x) * crossing.side;
    let point = vec3(e * at.y, at.x);
    let ahead = cross(disc.axis, disc.node);
    let azimuth = full_angle(normalize(vec2(dot(point, disc.node), dot(point, ahead))));

    // How ln r and the azimuth change with the view angle and with the azimuth of the ray.
    let axis = axis_in_plane(seen) * vec3(1.0, crossing.side, crossing.side);
    var speed = axis.y * at.x - axis.x * at.y;
    speed = select(min(speed, -1e-6), max(speed, 1e-6), speed >= 0.0);
    let s = sqrt(orbit.inv_b_sq.value);
    let u_here = orbit_inverse_radius(s, crossing.phase);
    let by_s = (orbit_inverse_radius(1.01 * s, crossing.phase) - u_here) / (0.01 * u_here);
    let by_phase = (u_here - orbit_inverse_radius(s, 0.99 * crossing.phase)) / (0.01 * crossing.phase * u_here);
    let relative = 0.5 * orbit.inv_b_sq.slope / orbit.inv_b_sq.value;
    let radial = -(by_s * relative + by_phase * crossing.turn);
    let p = max(seen.p, 1e-6);
    let tangential = vec2(-by_phase * axis.z * at.y / speed, -at.y / speed) / p;
    let right = vec2(radial * seen.right.x, 0.0) + tangential * seen.right.y;
    let down = vec2(radial * seen.down.x, 0.0) + tangential * seen.down.y;

    let place = vec2(-log(u), azimuth);
    let velocity = angular_velocity(u);
    let first = layer_of_clouds(place, right, down, velocity, disc.ages.x, disc.seeds.x);
    let second = layer_of_clouds(place, right, down, velocity, disc.ages.y, disc.seeds.y);
    let sum = dot(disc.weights, vec2(first, second));
    return 1.0 + disc.contrast * clamp(1.3 * sum, -1.0, 1.0);
}
