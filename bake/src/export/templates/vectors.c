
typedef struct {
    float x, y;
} $function_vec2;

typedef struct {
    float x, y, z;
} $function_vec3;

static inline $function_vec2 $function_make_vec2(float x, float y) {
    $function_vec2 made = {x, y};
    return made;
}

static inline $function_vec3 $function_make_vec3(float x, float y, float z) {
    $function_vec3 made = {x, y, z};
    return made;
}
