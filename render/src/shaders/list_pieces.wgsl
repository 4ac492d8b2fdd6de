// Inserts the light of the pieces of arcs into the linked lists: one invocation for each piece. It is a program of its own
// because a software adapter executes both sides of every branch.
// #import insert_light
// #import inverse_lens

// A piece of an arc: light at a point of the picture.
struct Piece {
    at: vec2<f32>,
    kernel: u32,
    light: vec3<f32>,
}

@group(0) @binding(4) var<storage, read> pieces: array<Piece>;

@compute @workgroup_size(64)
fn list_pieces(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x < lens.pieces {
        let piece = pieces[id.x];
        insert(piece.at, piece.kernel, piece.light);
    }
}
