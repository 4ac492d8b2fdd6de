// Cube maps of the sky for example.js, with mipmaps: the picture of the sky is squeezed near the edge of the shadow.
// A direction (x, y, z) is looked up with textureCube(sky, vec3(x, y, z)).

import * as THREE from 'three';

/** Texels along an edge of a face of the drawn skies: 0.11 degrees each at the centre of a face. */
const FACE = 1024;

/** Near the edge of the shadow a pixel covers far more of the sky in one direction than across it. */
const FILTER = { generateMipmaps: true, anisotropy: 16 };

/** Light of a sky in the unit direction d. */
const DRAWN = {
    // Lines of 10 degrees of longitude and latitude, over a colour for each direction.
    grid: /* glsl */ `
        vec3 light(vec3 d) {
            vec2 angles = vec2(atan(d.x, -d.z), asin(clamp(d.y, -1.0, 1.0))) * 18.0 / 3.14159265;
            vec2 off = abs(fract(angles - 0.5) - 0.5) * vec2(sqrt(max(1.0 - d.y * d.y, 0.0)), 1.0);
            float line = 1.0 - smoothstep(0.02, 0.04, min(off.x, off.y));
            return mix(0.08 + 0.16 * (0.5 + 0.5 * d), vec3(0.75), line);
        }`,
    // Clouds of gas and stars.
    nebula: /* glsl */ `
        // A number from 0 to 1 for each point of a lattice.
        float hash(vec3 p) {
            uvec3 q = uvec3(ivec3(p)) * uvec3(1597334673u, 3812015801u, 2798796415u);
            uint n = (q.x ^ q.y ^ q.z) * 1597334673u;
            return float((n ^ (n >> 15)) * 2246822519u >> 8) / 16777216.0;
        }
        float noise(vec3 p) {
            vec3 cell = floor(p), t = p - cell;
            t = t * t * (3.0 - 2.0 * t);
            vec4 left = vec4(hash(cell), hash(cell + vec3(0, 1, 0)),
                             hash(cell + vec3(0, 0, 1)), hash(cell + vec3(0, 1, 1)));
            vec4 right = vec4(hash(cell + vec3(1, 0, 0)), hash(cell + vec3(1, 1, 0)),
                              hash(cell + vec3(1, 0, 1)), hash(cell + vec3(1, 1, 1)));
            vec4 x = mix(left, right, t.x);
            return mix(mix(x.x, x.y, t.y), mix(x.z, x.w, t.y), t.z);
        }
        float clouds(vec3 p) {
            float sum = 0.0, weight = 0.5;
            for (int octave = 0; octave < 5; octave++) {
                sum += weight * noise(p);
                weight *= 0.5;
                p = 2.03 * p.yzx + 7.1;
            }
            return sum;
        }
        // One star at most in each cell of a lattice that the unit sphere cuts through.
        vec3 stars(vec3 d, float cells, float share) {
            vec3 cell = floor(d * cells);
            float chance = hash(cell + 400.0);
            if (chance > share) {
                return vec3(0.0);
            }
            vec3 place = vec3(hash(cell + 500.0), hash(cell + 600.0), hash(cell + 700.0));
            vec3 to = normalize((cell + 0.25 + 0.5 * place) / cells);
            float off = acos(clamp(dot(to, d), -1.0, 1.0)) / 0.0014;
            vec3 colour = mix(vec3(1.0, 0.75, 0.55), vec3(0.7, 0.8, 1.0), hash(cell + 800.0));
            return colour * (0.15 + 1.5 * pow(1.0 - chance / share, 6.0)) * exp(-off * off);
        }
        vec3 light(vec3 d) {
            vec3 p = 2.2 * d + 40.0;
            float warp = clouds(p + 3.0);
            vec3 bent = p + 1.6 * vec3(warp, clouds(p + 11.0), 1.0 - warp);
            float gas = smoothstep(0.42, 0.80, clouds(bent));
            float dust = smoothstep(0.35, 0.75, clouds(1.7 * bent + 60.0));
            vec3 colour = mix(vec3(0.10, 0.22, 0.60), vec3(0.95, 0.30, 0.22), smoothstep(0.40, 0.62, clouds(p + 90.0)));
            vec3 sky = vec3(0.004, 0.006, 0.012) + 1.3 * gas * colour * (1.0 - 0.7 * dust);
            return sky + stars(d, 60.0, 0.25) + stars(d, 160.0, 0.12);
        }`,
};

/** Names of the drawn skies. */
export const NAMES = Object.keys(DRAWN);

/** A sky drawn by a shader: 'nebula' or 'grid'. */
export function drawnSky(renderer, name, minFilter = THREE.LinearMipmapLinearFilter) {
    const options = { ...FILTER, minFilter, colorSpace: THREE.SRGBColorSpace };
    const target = new THREE.WebGLCubeRenderTarget(FACE, options);
    const material = new THREE.ShaderMaterial({
        vertexShader: /* glsl */ `
            varying vec3 d;
            void main() {
                d = position;
                gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
            }`,
        fragmentShader: `varying vec3 d; ${DRAWN[name]} void main() { gl_FragColor = vec4(light(normalize(d)), 1.0); }`,
        side: THREE.BackSide,
        blending: THREE.NoBlending,
    });
    const box = new THREE.Mesh(new THREE.BoxGeometry(2, 2, 2), material);
    new THREE.CubeCamera(0.1, 10, target).update(renderer, box);
    box.geometry.dispose();
    material.dispose();
    return target;
}

/** The sky of a panorama (equirectangular, twice as wide as high), with its middle along +X as in all of three.js. */
export async function pictureSky(renderer, url, minFilter = THREE.LinearMipmapLinearFilter) {
    const picture = await new THREE.TextureLoader().loadAsync(url);
    const { width, height } = picture.image;
    if (width !== 2 * height) {
        picture.dispose();
        throw new Error(`${width} x ${height} pixels: a panorama of the whole sky is twice as wide as high`);
    }
    picture.minFilter = minFilter;
    picture.colorSpace = THREE.SRGBColorSpace;
    picture.wrapS = THREE.RepeatWrapping;
    // In the centre of a face a texel is then as wide as a pixel of the picture.
    const face = Math.min(4 * Math.ceil(width / Math.PI / 4), renderer.capabilities.maxCubemapSize, 4096);
    const target = new THREE.WebGLCubeRenderTarget(face, FILTER).fromEquirectangularTexture(renderer, picture);
    picture.dispose();
    return target;
}
