extends Node
# Draws picture.png and, if there is rays.bin, writes the directions of its rays to out.bin.

# Rays a line of the texture. A record of 8 numbers is two texels of four.
const ACROSS = 1024
const RECORD = 32
# Each ray is a column of 6 pixels: see rays.shader.
const PARTS = 6

var atlas


func _ready():
	var image = Image.new()
	if image.load("res://lensbake.exr") != OK:
		return fail("lensbake.exr cannot be read")
	print("atlas: ", image.get_size(), ", format ", image.get_format())
	if image.get_format() != Image.FORMAT_RGBH:
		return fail("the atlas is not of half floats")
	atlas = texture(image, Texture.FLAG_FILTER)

	var picture = yield(render("res://picture.shader", Vector2(960, 540), {}), "completed")
	if picture.save_png("res://picture.png") != OK:
		return fail("picture.png cannot be written")

	var file = File.new()
	if file.file_exists("res://rays.bin"):
		if file.open("res://rays.bin", File.READ) != OK:
			return fail("rays.bin cannot be read")
		var bytes = file.get_buffer(file.get_len())
		file.close()
		if bytes.size() == 0 or bytes.size() % RECORD != 0:
			return fail("rays.bin does not consist of records of 32 bytes")
		var count = bytes.size() / RECORD
		var lines = (count + ACROSS - 1) / ACROSS
		bytes.resize(lines * ACROSS * RECORD)
		var rays = Image.new()
		rays.create_from_data(2 * ACROSS, lines, false, Image.FORMAT_RGBAF, bytes)
		var parts = yield(render("res://rays.shader", Vector2(ACROSS, PARTS * lines), {"rays": texture(rays, 0)}),
				"completed")
		parts.convert(Image.FORMAT_RGB8)
		if file.open("res://out.bin", File.WRITE) != OK:
			return fail("out.bin cannot be written")
		file.store_buffer(directions(parts.get_data(), count))
		file.close()
		print("rays: ", count)
	get_tree().quit(0)


func fail(message):
	printerr("ERROR: ", message)
	get_tree().quit(1)


func texture(image, flags):
	var result = ImageTexture.new()
	result.create_from_image(image, flags)
	return result


# The pixels of a rectangle of the size with the shader, 8 bits a channel.
func render(shader, size, parameters):
	var material = ShaderMaterial.new()
	material.shader = load(shader)
	material.set_shader_param("atlas", atlas)
	material.set_shader_param("size", size)
	for name in parameters:
		material.set_shader_param(name, parameters[name])
	var rectangle = ColorRect.new()
	rectangle.rect_size = size
	rectangle.material = material
	var viewport = Viewport.new()
	viewport.size = size
	viewport.usage = Viewport.USAGE_2D
	# HDR would be 16-bit floats.
	viewport.hdr = false
	viewport.render_target_update_mode = Viewport.UPDATE_ALWAYS
	viewport.render_target_v_flip = true
	viewport.add_child(rectangle)
	add_child(viewport)
	yield(get_tree(), "idle_frame")
	yield(get_tree(), "idle_frame")
	var image = viewport.get_texture().get_data()
	viewport.queue_free()
	return image


# The bytes of three 32-bit floats a ray, in the order of the rays.
func directions(pixels, count):
	var result = PoolByteArray()
	result.resize(12 * count)
	for ray in range(count):
		var at = 3 * (ray / ACROSS * PARTS * ACROSS + ray % ACROSS)
		for component in range(3):
			var low = at + 3 * ACROSS * 2 * component
			for byte in range(3):
				result[12 * ray + 4 * component + byte] = pixels[low + byte]
			result[12 * ray + 4 * component + 3] = pixels[low + 3 * ACROSS]
	return result
