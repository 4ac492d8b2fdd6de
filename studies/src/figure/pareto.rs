//! Which methods no other beats.

/// Indices of the points (cost, error) that no other is both cheaper and more accurate than, cheapest
/// first.
pub fn front(points: &[(f64, f64)]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&a, &b| {
        let (a, b) = (points[a], points[b]);
        a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    let mut least = f64::INFINITY;
    order.retain(|&i| {
        let better = points[i].1 < least;
        least = least.min(points[i].1);
        better
    });
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_is_a_staircase() {
        let points = [(3.0, 1.0), (1.0, 5.0), (2.0, 6.0), (4.0, 0.5), (5.0, 0.7)];
        assert_eq!(front(&points), [1, 0, 3]);
        assert_eq!(front(&[(1.0, 2.0), (1.0, 1.0)]), [1]);
        assert!(front(&[]).is_empty());
    }
}
