shader_type canvas_item;
render_mode unshaded, blend_disabled;

// lensbake

uniform sampler2D atlas;
// A ray is two texels: r, d; hole, 0.
uniform sampler2D rays;
uniform vec2 size;

// A canvas has 8 bits a channel, so the 32 bits of each component of the direction go to two pixels, one below the
// other: bits 0 to 23, then 24 to 31.
void fragment() {
	ivec2 pixel = ivec2(UV * size);
	int part = pixel.y % 6;
	vec4 observer = texelFetch(rays, ivec2(2 * pixel.x, pixel.y / 6), 0);
	vec4 hole = texelFetch(rays, ivec2(2 * pixel.x + 1, pixel.y / 6), 0);
	vec3 from = lensbake(observer.yzw, hole.xyz, observer.x, atlas);
	uint bits = floatBitsToUint(part < 2 ? from.x : (part < 4 ? from.y : from.z));
	if (part % 2 == 1) {
		bits = bits >> uint(24);
	}
	uvec3 bytes = uvec3(bits, bits >> uint(8), bits >> uint(16)) & uvec3(uint(255));
	COLOR = vec4(vec3(bytes) / 255.0, 1.0);
}
