// What is summed up once for a column of pixels: nothing.
fn begin_column(first: vec2<u32>) {
}
