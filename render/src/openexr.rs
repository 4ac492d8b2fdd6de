//! Writes pictures as OpenEXR files: the channels R, G and B in linear light, those of the layers beside them, and
//! metadata in the header. All samples are 32-bit floats.
//!
//! One part of scan lines with ZIP compression, because every reader knows that: tinyexr reads zeros from tiles, and some
//! compositors show only the first part of several.

use crate::layers::Channel;
use crate::picture::{Picture, PictureError};
use exr::prelude::{
    AnyChannel, AnyChannels, AttributeValue, Encoding, FlatSamples, Image, Layer, LayerAttributes,
    SpecificChannels, Text, Vec2, WritableImage,
};
use lensbake_tables::exr_attributes::{encode_text, in_order};
use std::io::Cursor;

/// What the header of a picture says about it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Metadata {
    /// The standard attribute `software`: the program that made the picture. Not written if it is empty.
    pub software: String,
    /// The standard attribute `comments`: a description for people. Not written if it is empty.
    pub comments: String,
    /// Further attributes: names, of at most 31 bytes of ASCII, and values.
    pub attributes: Vec<(&'static str, Value)>,
}

/// The value of an attribute.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A text, in UTF-8.
    Text(String),
    /// A number.
    Real(f64),
}

/// The bytes of an OpenEXR file of `picture` with the channels of `layers`. The same arguments give the same bytes.
///
/// # Errors
/// [`PictureError::EncodeOpenExr`] if the encoder fails.
///
/// # Panics
/// If a channel has another number of samples than the picture has pixels.
pub fn encode(
    picture: &Picture,
    layers: Vec<Channel>,
    metadata: &Metadata,
) -> Result<Vec<u8>, PictureError> {
    if layers.is_empty() {
        return encode_light(picture, metadata);
    }
    let of_picture = ["R", "G", "B"]
        .into_iter()
        .enumerate()
        .map(|(index, name)| {
            let samples = picture.pixels().iter().map(|pixel| pixel[index]);
            AnyChannel::new(name, FlatSamples::F32(samples.collect()))
        });
    let of_layers = layers.into_iter().map(|channel| {
        assert_eq!(channel.samples.len(), picture.pixels().len());
        AnyChannel::new(channel.name.as_str(), FlatSamples::F32(channel.samples))
    });
    let layer = Layer::new(
        (picture.width() as usize, picture.height() as usize),
        attributes(metadata),
        Encoding::SMALL_LOSSLESS,
        AnyChannels::sort(of_picture.chain(of_layers).collect()),
    );
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer).write().to_buffered(&mut bytes)?;
    Ok(in_order(bytes.into_inner()))
}

/// As [`encode`] without layers. The light of a large picture is not copied.
fn encode_light(picture: &Picture, metadata: &Metadata) -> Result<Vec<u8>, PictureError> {
    let width = picture.width() as usize;
    let light = |at: Vec2<usize>| {
        let [r, g, b] = picture.pixels()[at.y() * width + at.x()];
        (r, g, b)
    };
    let layer = Layer::new(
        (width, picture.height() as usize),
        attributes(metadata),
        Encoding::SMALL_LOSSLESS,
        SpecificChannels::rgb(light),
    );
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer).write().to_buffered(&mut bytes)?;
    Ok(in_order(bytes.into_inner()))
}

fn attributes(metadata: &Metadata) -> LayerAttributes {
    let written = |text: &String| (!text.is_empty()).then(|| encode_text(text));
    let others = metadata.attributes.iter().map(|(name, value)| {
        let value = match value {
            Value::Text(text) => AttributeValue::Text(encode_text(text)),
            Value::Real(number) => AttributeValue::F64(*number),
        };
        (Text::from(*name), value)
    });
    LayerAttributes {
        software_name: written(&metadata.software),
        comments: written(&metadata.comments),
        other: others.collect(),
        ..LayerAttributes::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use exr::prelude::{ReadChannels, ReadLayers, read};
    use lensbake_tables::exr_guard::text_attribute;

    fn picture() -> Picture {
        Picture::new(2, 1, vec![[0.0, 0.5, 1.0], [3.0, 0.25, 0.125]])
    }

    fn channel(name: &str, samples: [f32; 2]) -> Channel {
        Channel {
            name: name.to_owned(),
            samples: samples.to_vec(),
        }
    }

    #[test]
    fn a_file_holds_picture_layers_and_metadata_and_is_always_the_same() {
        let metadata = Metadata {
            software: "a program".to_owned(),
            comments: String::new(),
            attributes: vec![
                ("lensbake.place", Value::Text("Åre, 上海".to_owned())),
                ("lensbake.radius", Value::Real(10.5)),
            ],
        };
        let encode = || {
            let layers = vec![channel("uv.V", [1e-30, -2.0]), channel("uv.U", [0.1, 7e9])];
            encode(&picture(), layers, &metadata).unwrap()
        };
        let file = encode();
        for _ in 0..20 {
            assert!(encode() == file, "another order of attributes");
        }
        let all = read().no_deep_data().largest_resolution_level();
        let all = all.all_channels().first_valid_layer().all_attributes();
        let found = all.from_buffered(Cursor::new(&file)).unwrap().layer_data;
        let channels: Vec<_> = found.channel_data.list.iter().collect();
        let names: Vec<_> = channels.iter().map(|c| c.name.to_string()).collect();
        assert_eq!(names, ["B", "G", "R", "uv.U", "uv.V"]);
        let samples = |index: usize| match &channels[index].sample_data {
            FlatSamples::F32(samples) => samples.clone(),
            other => panic!("{other:?}"),
        };
        assert_eq!(samples(2), [0.0, 3.0]);
        assert_eq!(samples(3), [0.1, 7e9]);
        assert_eq!(samples(4), [1e-30, -2.0]);
        let text = |name| text_attribute(&file, name).unwrap();
        assert_eq!(text("lensbake.place").as_deref(), Some("Åre, 上海"));
        assert_eq!(text("lensbake.radius"), None, "it is no text");
        assert_eq!(text("comments"), None);
        let software = found.attributes.software_name.unwrap();
        assert_eq!(software.to_string(), "a program");
    }
}
