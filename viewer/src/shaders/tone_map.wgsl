// From the light of the sky to what a screen can show. Twin of tone_map.rs.

// Light up to here is left alone.
const KNEE: f32 = 0.8;

// The light as a screen shows it, linear and at most 1 a channel, at an exposure in stops.
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
