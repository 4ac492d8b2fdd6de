//! A cube map at a higher resolution, a row of texels at a time.

use glam::Vec3;
use pulp::{Arch, Simd, WithSimd};
use std::array::from_fn;

use super::cube::{Cube, FACES, FaceAxes, floor_and_fraction};
use super::texel_direction;

impl Cube {
    /// Fills in the light from the directions of a row of texels of a larger cube map, with `face_texels` texels along the
    /// edge of a face; to the last bit what [`Cube::sample`] returns for each of them.
    pub(super) fn sample_row(&self, face_texels: u32, face: usize, row: u32, light: &mut [Vec3]) {
        let places = places(self.face_texels(), face_texels, face, row);
        // Nearly all texels lie between the same two rows, which are decoded at once.
        let inside = 0..self.face_texels() as i32 - 1;
        let (above, _) = places[places.len() / 2].1;
        let rows = inside
            .contains(&above)
            .then(|| [above, above + 1].map(|row| self.decoded_row(face, row as u32)));
        for ((column, texel), ((left, x), (top, y))) in (0..).zip(light).zip(places) {
            *texel = match &rows {
                Some([first, second]) if top == above && inside.contains(&left) => {
                    let i = left as usize;
                    let [red, green, blue, _] = mix(
                        mix(first[i], first[i + 1], x),
                        mix(second[i], second[i + 1], x),
                        y,
                    );
                    Vec3::new(red, green, blue)
                }
                _ => self.sample(texel_direction(face_texels, face, column, row)),
            };
        }
    }
}

fn mix(a: [f32; 4], b: [f32; 4], t: f32) -> [f32; 4] {
    from_fn(|i| a[i] * (1.0 - t) + b[i] * t)
}

/// Column and row, each with its fraction, at which the directions of a row of texels lie on the same face of a cube map with
/// `n` texels along its edge.
fn places(n: u32, face_texels: u32, face: usize, row: u32) -> Vec<((i32, f32), (i32, f32))> {
    let [mut columns, mut rows] = [(); 2].map(|()| vec![0.0; face_texels as usize]);
    Arch::new().dispatch(FillPlaces {
        n: n as f32,
        axes: FACES[face],
        face_texels,
        row,
        columns: &mut columns,
        rows: &mut rows,
    });
    let places = columns.into_iter().zip(rows);
    places
        .map(|(column, row)| (floor_and_fraction(column), floor_and_fraction(row)))
        .collect()
}

/// Fills in the columns and rows of [`places`], counted from the centre of the first texel.
struct FillPlaces<'a> {
    n: f32,
    axes: FaceAxes,
    face_texels: u32,
    row: u32,
    columns: &'a mut [f32],
    rows: &'a mut [f32],
}

impl WithSimd for FillPlaces<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let places = self.columns.iter_mut().zip(self.rows);
        for (column, (x, y)) in (0..self.face_texels).zip(places) {
            let dir = self
                .axes
                .texel_direction(self.face_texels, column, self.row);
            let (_, u, v) = self.axes.plane_coordinates(dir);
            *x = u * self.n - 0.5;
            *y = v * self.n - 0.5;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_is_what_its_texels_are_sampled_as() {
        for (n, face_texels) in [(1, 1), (1, 2), (2, 3), (17, 33), (32, 64), (40, 57)] {
            let cube = Cube::from_fn(n, |dir| (7.0 * dir).map(f32::sin).abs());
            for (face, row) in (0..6).flat_map(|face| (0..face_texels).map(move |row| (face, row)))
            {
                let mut light = vec![Vec3::ZERO; face_texels as usize];
                cube.sample_row(face_texels, face, row, &mut light);
                for (column, light) in (0..).zip(light) {
                    let dir = texel_direction(face_texels, face, column, row);
                    assert_eq!(
                        light,
                        cube.sample(dir),
                        "{n} {face_texels} {face} {row} {column}"
                    );
                }
            }
        }
    }
}
