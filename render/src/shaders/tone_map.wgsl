// The tone map: from the light of the sky to what a screen can show. tone_map.rs is its mirror.
// #import constants

// The light as a screen shows it, linear and at most 1 per channel, at an exposure in stops.
fn tone_map(light: vec3<f32>, exposure: f32) -> vec3<f32> {
    let exposed = light * exp2(exposure);
    let peak = max(exposed.x, max(exposed.y, exposed.z));
    if peak <= KNEE {
        return exposed;
    }
    let room = 1.0 - KNEE;
    let rolled = 1.0 - room * room / (peak - KNEE + room);
    return exposed * (rolled / peak);
}
