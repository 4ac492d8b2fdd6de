extends RefCounted
## The row of one observer, for the shader of `bake export --to gdshaderinc --mode row`.

const TEXELS := 64
const ROWS := 128


## The atlas: values and slopes of all rows.
static func load_atlas(path: String) -> PackedFloat32Array:
	var atlas := FileAccess.get_file_as_bytes(path).to_float32_array()
	assert(atlas.size() == 2 * TEXELS * ROWS, "not an atlas of 64 texels a row")
	return atlas


## The row of the observer at rest at r > 1 (in Schwarzschild radii; INF is allowed): value and slope of each texel,
## mixed from four rows of the atlas by Lagrange's cubic. At the ends of the atlas all four rows are inside it.
static func mix_row(atlas: PackedFloat32Array, r: float) -> PackedFloat32Array:
	assert(r > 1.0, "an observer at rest is outside the horizon, r > 1")
	var u := 1.0 / r
	var position := atan2(sqrt(u), sqrt(1.0 - u)) / (PI / 2.0) * (ROWS - 1)
	var first := int(clamp(floor(position) - 1.0, 0.0, ROWS - 4.0))
	var t := position - first
	var weights := [
		-(t - 1.0) * (t - 2.0) * (t - 3.0) / 6.0,
		t * (t - 2.0) * (t - 3.0) / 2.0,
		-t * (t - 1.0) * (t - 3.0) / 2.0,
		t * (t - 1.0) * (t - 2.0) / 6.0,
	]
	var row := PackedFloat32Array()
	row.resize(2 * TEXELS)
	for i in range(2 * TEXELS):
		var mixed := 0.0
		for k in range(4):
			mixed += weights[k] * atlas[2 * TEXELS * (first + k) + i]
		row[i] = mixed
	return row


## The image of a row, for ImageTexture.create_from_image once and ImageTexture.update when r changes.
static func row_image(row: PackedFloat32Array) -> Image:
	return Image.create_from_data(TEXELS, 1, false, Image.FORMAT_RGF, row.to_byte_array())
