//! The text after its header: the functions in the language, and what the language needs around them.

use super::numbers::{Numbers, Precision};
use super::rewrite::rewrite;
use super::source::{CONSTANT_ARRAY, Place, Shape};
use super::{Language, Request};
use lensbake_tables::Axis;
use lensbake_tables::lookup::HorizonSide;

/// The text for `request`, whose lookup has this shape and looks up these numbers.
pub fn text(request: &Request, shape: &Shape, numbers: &Numbers) -> String {
    let Some(dialect) = request.language.dialect() else {
        return python(request, shape, numbers);
    };
    let functions = shape.functions(numbers, dialect);
    let functions = rewrite(&functions, dialect, &request.function);
    let in_text =
        matches!(shape.place, Place::Array | Place::Atlas) || request.language == Language::C;
    let count = numbers.stored().len() * 2;
    let array = match in_text && dialect.has_constants {
        true => {
            let lines = numbers.lines(dialect.float_suffix);
            format!(
                "\n// Value and slope of each texel.\n{}",
                dialect.constant_array(CONSTANT_ARRAY, count, &lines)
            )
        }
        false => String::new(),
    };
    let text = format!("{array}\n{functions}");
    let text = match request.language {
        Language::Wgsl => text,
        // Some versions of Godot write numbers with 14 decimals when they translate a shader.
        Language::Gdshaderinc => text.replace("1e-30", "1e-12"),
        Language::Glsl | Language::Hlsl => guarded(&text, ""),
        Language::Msl => guarded(&text, "#include <metal_stdlib>\n"),
        Language::C => guarded(&c(&text, shape), "#include <math.h>\n"),
        Language::Osl => osl(&text, shape, numbers),
        Language::Shadertoy => text + include_str!("templates/shadertoy.glsl"),
        Language::Three => three(request, shape, &text),
        Language::Python => text,
    };
    let text = text
        .replace("$guard", &(request.function.to_uppercase() + "_INCLUDED"))
        .replace("$function", &request.function);
    match request.language {
        Language::Wgsl => text,
        _ => in_ascii(&text),
    }
}

/// `text` in which nothing is declared twice if it is included twice.
fn guarded(text: &str, includes: &str) -> String {
    format!("\n#ifndef $guard\n#define $guard\n{includes}{text}\n#endif\n")
}

/// Not all compilers take other characters, even in comments.
fn in_ascii(text: &str) -> String {
    const WORDS: [(char, &str); 15] = [
        ('θ', "theta"),
        ('Δ', "Delta"),
        ('π', "pi"),
        ('√', "sqrt "),
        ('′', "'"),
        ('²', "^2"),
        ('−', "-"),
        ('·', "*"),
        ('×', "x"),
        ('≥', ">="),
        ('≤', "<="),
        ('∞', "infinity"),
        ('σ', "sigma"),
        ('χ', "chi"),
        ('φ', "phi"),
    ];
    let mut ascii = String::with_capacity(text.len());
    for character in text.chars() {
        match WORDS.iter().find(|(own, _)| *own == character) {
            Some((_, word)) => ascii += word,
            None => ascii.push(character),
        }
    }
    ascii
}

/// The structs that stand for vectors before `text`, and after it the function that mixes a row.
fn c(text: &str, shape: &Shape) -> String {
    let mixing = match shape.place {
        Place::Row => include_str!("templates/row.c")
            .replace("ROW_LENGTH", &(2 * shape.texels).to_string())
            .replace("ROW_COUNT", &shape.rows.to_string()),
        _ => String::new(),
    };
    format!("{}{text}{mixing}", include_str!("templates/vectors.c"))
}

fn osl(text: &str, shape: &Shape, numbers: &Numbers) -> String {
    let (parameter, arguments) = match shape.edge {
        Some(_) => ("", "row"),
        None => (
            "    float radius = 10.0 [[ string label = \"Radius\", float min = 1.0001, float max = 1000000.0 ]],\n",
            "radius, row",
        ),
    };
    let camera = include_str!("templates/camera.osl")
        .replace("PARAMETERS", parameter)
        .replace("ROW_LENGTH", &(2 * numbers.stored().len()).to_string())
        .replace("NUMBERS", &numbers.lines(""))
        .replace("ARGUMENTS", arguments);
    format!("{}{text}{camera}", include_str!("templates/vectors.osl"))
}

fn three(request: &Request, shape: &Shape, functions: &str) -> String {
    let (import, template) = match shape.place {
        Place::Row => (
            "DataTexture, FloatType, RGFormat",
            include_str!("templates/three_row.js"),
        ),
        Place::Filtered => (
            "DataTexture, LinearFilter, RedFormat",
            include_str!("templates/three_simple.js"),
        ),
        Place::Array | Place::Atlas => ("", ""),
    };
    let (number_type, texture_type, read) = match request.precision {
        Precision::F32 => ("Float32Array", "FloatType", "new Float32Array(bytes)"),
        Precision::F16 => (
            "Uint16Array",
            "HalfFloatType",
            "Float32Array.from(new Uint16Array(bytes), DataUtils.fromHalfFloat)",
        ),
        Precision::Unorm16 => (
            "Uint16Array",
            "",
            "Float32Array.from(new Uint16Array(bytes), (n) => n / 65535)",
        ),
    };
    let import = match (import, request.precision, shape.place) {
        ("", ..) => String::new(),
        (names, Precision::F16, Place::Row) => {
            format!("\nimport {{ DataUtils, {names} }} from 'three';\n")
        }
        (names, _, Place::Filtered) => {
            format!("\nimport {{ {names}, {texture_type} }} from 'three';\n")
        }
        (names, ..) => format!("\nimport {{ {names} }} from 'three';\n"),
    };
    let file = request.data.as_ref().and_then(|(path, _)| path.file_name());
    let file = file.map_or(String::new(), |name| name.to_string_lossy().into_owned());
    let template = template
        .replace("TEXEL_COUNT", &shape.texels.to_string())
        .replace("ROW_COUNT", &shape.rows.to_string())
        .replace("NUMBER_TYPE", number_type)
        .replace("READ_NUMBERS", read)
        .replace("TEXTURE_TYPE", texture_type)
        .replace("DATA_FILE", &file);
    format!(
        "{import}\n/** The functions, to be put before the main function of a shader. */\n\
         export const glsl = /* glsl */ `{functions}`;\n{template}"
    )
}

fn python(request: &Request, shape: &Shape, numbers: &Numbers) -> String {
    let Some(observer) = request.observer else {
        return String::new();
    };
    let axis = Axis::Residual.of(&observer);
    let scale = axis.edge_scale(&observer);
    let tan_half = observer.tan_half_shadow() / scale;
    let log_weight = axis.log_weight(&observer);
    let position = match shape.side {
        HorizonSide::Above => include_str!("templates/position_above.py"),
        HorizonSide::Below => include_str!("templates/position_below.py"),
    };
    let decode = numbers
        .decode_array("\nROW = np.stack([VALUE_SCALE ROW[:, 0], SLOPE_SCALE ROW[:, 1]], axis=1)");
    let decode = if request.precision == Precision::Unorm16 {
        decode
    } else {
        String::new()
    };
    include_str!("templates/one_row.py")
        .replace("TAN_HALF_NUMBER", &format!("{tan_half:?}"))
        .replace("LOG_WEIGHT_NUMBER", &format!("{log_weight:?}"))
        .replace("SCALE_NUMBER", &format!("{scale:?}"))
        .replace("POSITION\n", position)
        .replace("NUMBERS", &numbers.lines(""))
        .replace("DECODE", &decode)
        .replace("$function", &request.function)
}
