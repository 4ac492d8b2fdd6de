extends Camera3D
## Drag to look around, turn the wheel to come closer or to go away.

const RADIANS_PER_PIXEL := 0.002
const NEAREST := 1.02
const FARTHEST := 1000.0

@export var sky_material: ShaderMaterial

var radius := 10.0


func _unhandled_input(event: InputEvent) -> void:
	if event is InputEventMouseMotion and (event.button_mask & MOUSE_BUTTON_MASK_LEFT) != 0:
		rotation.y += event.relative.x * RADIANS_PER_PIXEL
		rotation.x = clampf(rotation.x + event.relative.y * RADIANS_PER_PIXEL, -PI / 2.0, PI / 2.0)
	elif event is InputEventMouseButton and event.pressed:
		if event.button_index == MOUSE_BUTTON_WHEEL_UP:
			set_radius(1.0 + (radius - 1.0) / 1.1)
		elif event.button_index == MOUSE_BUTTON_WHEEL_DOWN:
			set_radius(1.0 + (radius - 1.0) * 1.1)


func set_radius(value: float) -> void:
	radius = clampf(value, NEAREST, FARTHEST)
	sky_material.set_shader_parameter("radius", radius)
