use super::*;
use crate::sky::noise::Random;

/// A cube map with random light in each texel, the worst case for a seam.
fn random_sky(face_texels: u32) -> Cube {
    let n = face_texels;
    let mut random = Random::new(11);
    let values: Vec<f32> = (0..6 * n * n).map(|_| random.unit()).collect();
    Cube::from_rows(n, |face, row, texels| {
        for (column, texel) in texels.iter_mut().enumerate() {
            let index = (face * n as usize + row as usize) * n as usize + column;
            *texel = Vec3::new(values[index], 1.0 - values[index], 0.5);
        }
    })
}

#[test]
fn texel_direction_and_face_coordinates_are_inverse() {
    let mut checked = 0;
    for n in [1, 2, 5, 64] {
        for (face, row, column) in
            (0..6).flat_map(|f| (0..n).flat_map(move |r| (0..n).map(move |c| (f, r, c))))
        {
            let dir = texel_direction(n, face, column, row);
            assert!((dir.length() - 1.0).abs() < 1e-6);
            let (found, u, v) = face_coordinates(7.0 * dir);
            assert_eq!(found, face);
            assert!((u * n as f32 - column as f32 - 0.5).abs() < 1e-4);
            assert!((v * n as f32 - row as f32 - 0.5).abs() < 1e-4);
            checked += 1;
        }
    }
    assert_eq!(checked, 6 * (1 + 4 + 25 + 4096));
}

/// The table of the Vulkan specification, "Cube Map Face Selection": s_c, t_c and r_c by face.
#[test]
fn faces_follow_the_vulkan_table() {
    let table: [fn(Vec3) -> [f32; 3]; 6] = [
        |r| [-r.z, -r.y, r.x],
        |r| [r.z, -r.y, r.x],
        |r| [r.x, r.z, r.y],
        |r| [r.x, -r.z, r.y],
        |r| [r.x, -r.y, r.z],
        |r| [-r.x, -r.y, r.z],
    ];
    let mut random = Random::new(1);
    let mut seen = [0; 6];
    for _ in 0..600 {
        let dir = random.direction();
        let (face, u, v) = face_coordinates(dir);
        let [s, t, r] = table[face](dir);
        assert_eq!(r.abs(), dir.abs().max_element());
        assert_eq!(r < 0.0, face % 2 == 1);
        assert!((0.5 * s / r.abs() + 0.5 - u).abs() < 1e-6);
        assert!((0.5 * t / r.abs() + 0.5 - v).abs() < 1e-6);
        seen[face] += 1;
    }
    assert!(seen.iter().all(|&count| count > 50), "{seen:?}");
    assert_eq!(
        face_coordinates(Vec3::new(1.0, 1.0, 1.0)).0,
        4,
        "Z goes first"
    );
    assert_eq!(
        face_coordinates(Vec3::new(-1.0, -1.0, 0.0)).0,
        3,
        "Y goes before X"
    );
}

#[test]
fn texels_are_stored_layer_by_layer() {
    let sky = Cube::from_fn(3, |dir| 0.5 + 0.5 * dir);
    assert_eq!((sky.face_texels(), sky.texels().len()), (3, 54));
    let axes = [Vec3::X, -Vec3::X, Vec3::Y, -Vec3::Y, Vec3::Z, -Vec3::Z];
    for (face, axis) in axes.into_iter().enumerate() {
        let middle = sky.texels()[face * 9 + 4].map(f16::to_f32);
        assert_eq!(middle, (0.5 + 0.5 * axis).extend(1.0).to_array());
    }
}

#[test]
fn light_that_f16_cannot_hold_is_clamped() {
    let sky = Cube::from_fn(1, |_| Vec3::new(f32::NAN, -1.0, f32::INFINITY));
    assert_eq!(sky.sample(Vec3::X), Vec3::new(0.0, 0.0, 65504.0));
}

#[test]
fn a_constant_sky_is_constant() {
    let light = Vec3::new(0.25, 1.0, 3.0);
    let mut random = Random::new(2);
    for n in [1, 2, 7] {
        let sky = Cube::from_fn(n, |_| light);
        for _ in 0..2000 {
            let dir = random.direction();
            assert!(
                (sky.sample(dir) - light).abs().max_element() < 1e-6,
                "{n} {dir}"
            );
        }
    }
}

#[test]
fn a_smooth_sky_is_sampled_to_the_error_of_the_filter() {
    let light = |dir: Vec3| 0.5 + 0.5 * dir;
    let n = 64;
    let texel = 2.0 / n as f32;
    let sky = Cube::from_fn(n, light);
    let mut random = Random::new(3);
    let mut on_border = 0;
    for _ in 0..40_000 {
        let dir = random.direction();
        let (_, u, v) = face_coordinates(dir);
        let border = [u, v].iter().any(|x| (x - 0.5).abs() > 0.5 - 0.25 * texel);
        // Errors by rounding to f16 and by the curvature of the sky within a texel. Beyond an edge, the texels of
        // the neighbouring face lie up to half a texel off the line through those of this face.
        let bound = 2.5e-4 + 0.25 * texel * if border { 1.0 } else { texel };
        let error = (sky.sample(dir) - light(dir)).abs().max_element();
        assert!(error < bound, "{dir}: {error} is not below {bound}");
        on_border += u32::from(border);
    }
    assert!(on_border > 200, "{on_border}");
}

#[test]
fn the_twelve_edges_have_no_seam() {
    let sky = random_sky(8);
    let mut edges = 0;
    for axis in 0..3 {
        for (a, b) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
            for step in -100..=100 {
                let along = step as f32 / 100.5;
                let mut on_edge = [along; 3];
                (on_edge[(axis + 1) % 3], on_edge[(axis + 2) % 3]) = (a, b);
                let on_edge = Vec3::from(on_edge);
                let mut aside = Vec3::ZERO;
                aside[(axis + 1) % 3] = 1e-5 * a;
                let (one, other) = (on_edge + aside, on_edge - aside);
                assert_ne!(face_coordinates(one).0, face_coordinates(other).0);
                let jump = (sky.sample(one) - sky.sample(other)).abs().max_element();
                assert!(jump < 2e-4, "{on_edge}: {jump}");
            }
            edges += 1;
        }
    }
    assert_eq!(edges, 12);
}

#[test]
fn the_eight_corners_have_no_seam() {
    let sky = random_sky(8);
    for corner in 0..8 {
        let sign = |bit: i32| if corner >> bit & 1 == 0 { 1.0 } else { -1.0 };
        let corner = Vec3::new(sign(0), sign(1), sign(2));
        let mut mean = Vec3::ZERO;
        for face in (0..6).filter(|face| FACES[*face].outward.dot(corner) > 0.0) {
            // Sample just within each of the three faces; average the corner texels of the three.
            let axes = &FACES[face];
            let at_corner = sky.sample(corner + 1e-5 * axes.outward);
            let last = |along: Vec3| if along.dot(corner) > 0.0 { 7 } else { 0 };
            mean += sky.light(sky.index(face, last(axes.right), last(axes.down))) / 3.0;
            let jump = (at_corner - sky.sample(corner)).abs().max_element();
            assert!(jump < 2e-4, "{corner}: {jump}");
        }
        assert!((sky.sample(corner) - mean).abs().max_element() < 2e-4);
    }
}

#[test]
fn no_direction_panics() {
    let sky = random_sky(4);
    let odd = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        f32::MIN_POSITIVE,
        f32::MAX,
        f32::INFINITY,
        f32::NAN,
    ];
    let mut sampled = 0;
    for (x, y, z) in odd.into_iter().flat_map(|x| {
        odd.into_iter()
            .flat_map(move |y| odd.into_iter().map(move |z| (x, y, z)))
    }) {
        let _ = sky.sample(Vec3::new(x, y, z));
        sampled += 1;
    }
    assert_eq!(sampled, 512);
}

#[test]
fn positive_halves_are_converted_exactly() {
    for bits in 0..f16::INFINITY.to_bits() {
        let half = f16::from_bits(bits);
        assert_eq!(positive_to_f32(half).to_bits(), half.to_f32().to_bits());
    }
    assert_eq!(positive_to_f32(f16::NEG_ZERO), 0.0);
}

#[test]
fn a_face_is_met_where_its_axes_say() {
    let mut random = Random::new(3);
    for _ in 0..10_000 {
        let dir = random.direction();
        let (face, u, v) = face_coordinates(dir);
        let (_, plane_u, plane_v) = plane_coordinates(face, dir);
        assert_eq!((u, v), (plane_u, plane_v), "{dir}");
    }
}
