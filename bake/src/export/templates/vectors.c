
typedef struct {
    float x, y;
} FUNCTION_vec2;

typedef struct {
    float x, y, z;
} FUNCTION_vec3;

static inline FUNCTION_vec2 FUNCTION_make_vec2(float x, float y) {
    FUNCTION_vec2 made = {x, y};
    return made;
}

static inline FUNCTION_vec3 FUNCTION_make_vec3(float x, float y, float z) {
    FUNCTION_vec3 made = {x, y, z};
    return made;
}
