shader_type canvas_item;
render_mode unshaded, blend_disabled;

// lensbake

uniform sampler2D atlas;
uniform vec2 size;

// procedural_sky

// From r = 10, along -Z, 90 degrees across.
void fragment() {
	vec2 across = (UV * 2.0 - 1.0) * vec2(1.0, -size.y / size.x);
	vec3 from = lensbake(normalize(vec3(across, -1.0)), vec3(0.0, 0.0, -1.0), 10.0, atlas);
	vec3 colour = vec3(0.0);
	if (dot(from, from) > 0.5) {
		colour = procedural_sky(from);
	}
	// A sky shader writes linear colours, a canvas has sRGB.
	vec3 srgb = mix(12.92 * colour, 1.055 * pow(colour, vec3(0.4166667)) - 0.055, step(0.0031308, colour));
	COLOR = vec4(srgb, 1.0);
}
