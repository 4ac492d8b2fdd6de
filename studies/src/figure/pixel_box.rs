//! Boxes in a figure.

/// A box in pixels: left, top, right, bottom.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PixelBox {
    /// Left edge.
    pub left: i32,
    /// Top edge.
    pub top: i32,
    /// Right edge.
    pub right: i32,
    /// Bottom edge.
    pub bottom: i32,
}

impl PixelBox {
    /// The point of the box that is nearest to `point`.
    pub fn nearest_to(&self, (x, y): (i32, i32)) -> (i32, i32) {
        (
            x.clamp(self.left, self.right),
            y.clamp(self.top, self.bottom),
        )
    }

    /// The area that both boxes cover, pixels.
    pub fn overlap(&self, other: &PixelBox) -> i64 {
        let width = self.right.min(other.right) - self.left.max(other.left);
        let height = self.bottom.min(other.bottom) - self.top.max(other.top);
        i64::from(width.max(0)) * i64::from(height.max(0))
    }

    /// Whether a mark at this point would lie over the box.
    pub fn holds(&self, (x, y): (i32, i32)) -> bool {
        const MARK: i32 = 9;
        (self.left - MARK..=self.right + MARK).contains(&x)
            && (self.top - MARK..=self.bottom + MARK).contains(&y)
    }

    /// Whether it lies within the other box.
    pub fn within(&self, outer: &PixelBox) -> bool {
        self.left >= outer.left
            && self.top >= outer.top
            && self.right <= outer.right
            && self.bottom <= outer.bottom
    }
}
