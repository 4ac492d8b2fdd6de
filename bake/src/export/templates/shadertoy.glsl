
// The sky: a grid of 10 degrees with a glow, so that the bending shows. Put your own here.
vec3 sky(vec3 d) {
    vec2 grid = vec2(atan(d.x, -d.z), asin(clamp(d.y, -1.0, 1.0))) * 18.0 / 3.14159265;
    vec2 off = abs(fract(grid - 0.5) - 0.5);
    // The width of a pixel in cells of the grid: lines thinner than a pixel fade, and do not flicker.
    vec2 wide = length(fwidth(d)) * 5.73 / vec2(sqrt(max(1.0 - d.y * d.y, 1e-4)), 1.0) + 1e-3;
    vec2 line = clamp(0.5 + (0.05 - off) / wide, 0.0, 1.0) * min(0.1 / wide, 1.0);
    line = 1.0 - mix(line, vec2(0.1), clamp(2.0 * wide - 1.0, 0.0, 1.0));
    vec3 base = mix(vec3(0.05, 0.09, 0.22), vec3(0.55, 0.22, 0.10), 0.5 + 0.5 * d.y);
    base += vec3(0.9, 0.8, 0.6) * pow(max(dot(d, normalize(vec3(0.3, 0.2, 1.0))), 0.0), 40.0);
    return mix(vec3(0.75), base, line.x * line.y);
}

// The mouse turns the view; the hole lies along -Z.
void mainImage(out vec4 colour, in vec2 pixel) {
    vec2 at = (2.0 * pixel - iResolution.xy) / iResolution.x; // 90 degrees across
    vec2 turn = iMouse.z > 0.0 ? (iMouse.xy / iResolution.xy - 0.5) * vec2(6.0, -3.0) : vec2(0.0);
    vec3 d = normalize(vec3(at, -1.0));
    d.yz = mat2(cos(turn.y), sin(turn.y), -sin(turn.y), cos(turn.y)) * d.yz;
    d.xz = mat2(cos(turn.x), -sin(turn.x), sin(turn.x), cos(turn.x)) * d.xz;
    vec3 from = $function(d, vec3(0.0, 0.0, -1.0));
    vec3 light = sky(from); // for all pixels: it compares neighbours
    bool captured = dot(from, from) < 0.5;
    colour = vec4(captured ? vec3(0.0) : light, 1.0);
}
