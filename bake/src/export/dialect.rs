//! Syntax of each language, as far as the lookup needs it.

/// Syntax of a type conversion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cast {
    /// `float(x)`.
    Call,
    /// `(float)(x)`.
    Prefix,
}

/// Syntax of a language, for `rewrite`.
#[derive(Debug, Clone, Copy)]
pub struct Dialect {
    /// Types and built-in functions whose names differ from those of WGSL.
    names: &'static [(&'static str, &'static str)],
    /// Constructor of a vector of two components.
    pub make_vec2: &'static str,
    /// Function that selects one of two vectors of two components, in a language whose operator `?:` cannot.
    pub choose_vec2: Option<&'static str>,
    /// Constructor of a vector of three components.
    pub make_vec3: &'static str,
    /// Suffix of a floating-point literal.
    pub float_suffix: &'static str,
    /// Keywords before the return type of a function.
    pub function_prefix: &'static str,
    /// Parameter list of a function without parameters.
    pub no_parameters: &'static str,
    /// Syntax of a type conversion.
    pub cast: Cast,
    /// Whether structs are declared with `typedef`.
    pub typedef: bool,
    /// Syntax of a constant array.
    array: Array,
    /// Access to textures, in languages that have them.
    pub texture: Option<Texture>,
    /// Whether the language has constants outside of functions.
    pub has_constants: bool,
    /// Parameter and argument of a function that reads an array.
    pub array_parameter: [&'static str; 2],
}

/// How a constant array is written: `{type} {NAME}[{count}] = {open}…{close};`.
#[derive(Debug, Clone, Copy)]
struct Array {
    prefix: &'static str,
    open: &'static str,
    close: &'static str,
}

/// How a texture is passed to a function and read.
#[derive(Debug, Clone, Copy)]
pub struct Texture {
    /// Parameters and arguments of a function that loads texels of a row.
    pub row: [&'static str; 2],
    /// Expression of the texel `i` of the row: a vector.
    pub load: &'static str,
    /// Parameters and arguments of a function that samples the atlas.
    pub atlas: [&'static str; 2],
    /// Expression of the filtered value at the texture coordinates `x` and `y`.
    pub sample: &'static str,
}

const BRACES: Array = Array {
    prefix: "static const float ",
    open: "{",
    close: "}",
};

/// WGSL itself.
pub const WGSL: Dialect = Dialect {
    names: &[],
    make_vec2: "vec2<f32>",
    choose_vec2: None,
    make_vec3: "vec3<f32>",
    float_suffix: "",
    function_prefix: "",
    no_parameters: "",
    cast: Cast::Call,
    typedef: false,
    array: BRACES,
    texture: Some(Texture {
        row: ["row: texture_2d<f32>", "row"],
        load: "textureLoad(row, vec2<i32>(i, 0), 0).xy",
        atlas: [
            "atlas: texture_2d<f32>, linear_clamp: sampler",
            "atlas, linear_clamp",
        ],
        sample: "textureSampleLevel(atlas, linear_clamp, vec2<f32>(x, y), 0.0).x",
    }),
    has_constants: true,
    array_parameter: ["", ""],
};

/// GLSL 3.30 and later, and GLSL ES 3.00.
pub const GLSL: Dialect = Dialect {
    names: &[
        ("f32", "float"),
        ("i32", "int"),
        ("vec2", "vec2"),
        ("vec3", "vec3"),
    ],
    make_vec2: "vec2",
    make_vec3: "vec3",
    array: Array {
        prefix: "const float ",
        open: "float[](",
        close: ")",
    },
    texture: Some(Texture {
        row: ["highp sampler2D row", "row"],
        load: "texelFetch(row, ivec2(i, 0), 0).xy",
        atlas: ["highp sampler2D atlas", "atlas"],
        sample: "textureLod(atlas, vec2(x, y), 0.0).x",
    }),
    ..WGSL
};

/// Godot's shading language.
pub const GODOT: Dialect = Dialect {
    array: Array {
        prefix: "const float ",
        open: "{",
        close: "}",
    },
    texture: Some(Texture {
        row: ["sampler2D row", "row"],
        load: "texelFetch(row, ivec2(i, 0), 0).xy",
        atlas: ["sampler2D atlas", "atlas"],
        sample: "textureLod(atlas, vec2(x, y), 0.0).x",
    }),
    ..GLSL
};

/// HLSL.
pub const HLSL: Dialect = Dialect {
    names: &[
        ("f32", "float"),
        ("i32", "int"),
        ("vec2", "float2"),
        ("vec3", "float3"),
    ],
    make_vec2: "float2",
    make_vec3: "float3",
    array: BRACES,
    texture: Some(Texture {
        row: ["Texture2D row", "row"],
        load: "row.Load(int3(i, 0, 0)).xy",
        atlas: [
            "Texture2D atlas, SamplerState linear_clamp",
            "atlas, linear_clamp",
        ],
        sample: "atlas.SampleLevel(linear_clamp, float2(x, y), 0.0).x",
    }),
    ..WGSL
};

/// Metal's shading language.
pub const MSL: Dialect = Dialect {
    function_prefix: "inline ",
    array: Array {
        prefix: "constant float ",
        open: "{",
        close: "}",
    },
    texture: Some(Texture {
        row: ["metal::texture2d<float> row", "row"],
        load: "row.read(metal::uint2(uint(i), 0u), 0u).xy",
        atlas: [
            "metal::texture2d<float> atlas, metal::sampler linear_clamp",
            "atlas, linear_clamp",
        ],
        sample: "atlas.sample(linear_clamp, metal::float2(x, y), metal::level(0.0)).x",
    }),
    names: &[
        ("f32", "float"),
        ("i32", "int"),
        ("vec2", "metal::float2"),
        ("vec3", "metal::float3"),
        ("sqrt", "metal::sqrt"),
        ("log", "metal::log"),
        ("atan", "metal::atan"),
        ("round", "metal::round"),
        ("floor", "metal::floor"),
        ("min", "metal::min"),
        ("max", "metal::max"),
    ],
    make_vec2: "metal::float2",
    make_vec3: "metal::float3",
    ..HLSL
};

/// Open Shading Language, which has no vector of two components and no constants outside of shaders.
pub const OSL: Dialect = Dialect {
    names: &[
        ("f32", "float"),
        ("i32", "int"),
        ("bool", "int"),
        ("vec2", "$function_vec2"),
        ("vec3", "vector"),
    ],
    make_vec2: "$function_vec2",
    choose_vec2: Some("$function_choose"),
    make_vec3: "vector",
    texture: None,
    has_constants: false,
    array_parameter: ["float row[]", "row"],
    ..WGSL
};

/// C99, also as C++.
pub const C: Dialect = Dialect {
    names: &[
        ("f32", "float"),
        ("i32", "int"),
        ("bool", "int"),
        ("vec2", "$function_vec2"),
        ("vec3", "$function_vec3"),
        ("sqrt", "sqrtf"),
        ("log", "logf"),
        ("atan", "atanf"),
        ("round", "roundf"),
        ("floor", "floorf"),
        ("min", "fminf"),
        ("max", "fmaxf"),
    ],
    make_vec2: "$function_make_vec2",
    make_vec3: "$function_make_vec3",
    float_suffix: "f",
    function_prefix: "static inline ",
    no_parameters: "void",
    cast: Cast::Prefix,
    typedef: true,
    array: BRACES,
    texture: None,
    array_parameter: ["const float *row", "row"],
    ..WGSL
};

impl Dialect {
    /// Whether this is WGSL, in which the sources are.
    pub fn is_wgsl(&self) -> bool {
        self.names.is_empty()
    }

    /// The name in this language of a type or a built-in function whose name differs.
    pub fn type_or_builtin(&self, name: &str) -> Option<&'static str> {
        let known = self.names.iter().find(|(wgsl, _)| *wgsl == name);
        known.map(|(_, own)| *own)
    }

    /// The name in this language of the type `name`.
    pub fn type_name<'a>(&self, name: &'a str) -> &'a str {
        self.type_or_builtin(name).unwrap_or(name)
    }

    /// The declaration of a constant array of numbers that are written in lines, with a comma between two of them.
    pub fn constant_array(&self, name: &str, count: usize, lines: &str) -> String {
        if self.is_wgsl() {
            return format!(
                "var<private> {name}: array<f32, {count}> = array<f32, {count}>(\n{lines}\n);\n"
            );
        }
        let Array {
            prefix,
            open,
            close,
        } = self.array;
        format!("{prefix}{name}[{count}] = {open}\n{lines}\n{close};\n")
    }
}
