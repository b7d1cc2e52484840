//! The tables of a scene from its text, and where in the text an error lies.
//!
//! What serde derives for a table is compiled once for each kind of table that a deserializer has. TOML's own deserializer has three
//! kinds, two of them for dates and for spans, which no scene holds.

use std::fmt;
use std::ops::Range;

use serde::de::value::StrDeserializer;
use serde::de::{Deserialize, DeserializeSeed, Deserializer, Error as _, IntoDeserializer};
use serde::de::{MapAccess, SeqAccess, Unexpected, Visitor};
use serde::forward_to_deserialize_any;
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use crate::Scene;

/// An error in the text of a scene.
#[derive(Debug)]
pub(crate) struct TextError {
    message: String,
    span: Option<Range<usize>>,
}

impl TextError {
    /// What is wrong.
    pub fn message(&self) -> &str {
        &self.message
    }

    /// Where it lies, in bytes of the text.
    pub fn span(&self) -> Option<Range<usize>> {
        self.span.clone()
    }

    fn within(mut self, span: &Range<usize>) -> Self {
        self.span.get_or_insert_with(|| span.clone());
        self
    }
}

impl From<toml::de::Error> for TextError {
    fn from(error: toml::de::Error) -> Self {
        Self { message: error.message().to_owned(), span: error.span() }
    }
}

impl serde::de::Error for TextError {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self { message: message.to_string(), span: None }
    }
}

impl fmt::Display for TextError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for TextError {}

/// Reads the tables of a scene, without a check of their numbers.
pub(crate) fn scene_of(text: &str) -> Result<Scene, TextError> {
    let root = DeTable::parse(text)?;
    let span = root.span();
    Scene::deserialize(Place { value: &DeValue::Table(root.into_inner()), span })
}

/// A value of the text.
struct Place<'a> {
    value: &'a DeValue<'a>,
    span: Range<usize>,
}

impl<'a> From<&'a Spanned<DeValue<'a>>> for Place<'a> {
    fn from(value: &'a Spanned<DeValue<'a>>) -> Self {
        Self { span: value.span(), value: value.get_ref() }
    }
}

impl Place<'_> {
    fn unexpected(&self) -> Unexpected<'_> {
        match self.value {
            DeValue::String(text) => Unexpected::Str(text),
            DeValue::Integer(_) => self.integer().map_or(Unexpected::Other("integer"), Unexpected::Signed),
            DeValue::Float(_) => self.float().map_or(Unexpected::Other("number"), Unexpected::Float),
            DeValue::Boolean(value) => Unexpected::Bool(*value),
            DeValue::Datetime(_) => Unexpected::Other("date"),
            DeValue::Array(_) => Unexpected::Seq,
            DeValue::Table(_) => Unexpected::Map,
        }
    }

    fn integer(&self) -> Option<i64> {
        let digits = self.value.as_integer()?;
        i64::from_str_radix(digits.as_str(), digits.radix()).ok()
    }

    /// A number with a fraction or an exponent; `None` if it is too large.
    fn float(&self) -> Option<f64> {
        let digits = self.value.as_float()?.as_str();
        digits.parse().ok().filter(|x: &f64| !x.is_infinite() || digits.ends_with("inf"))
    }
}

impl<'de> Deserializer<'de> for Place<'_> {
    type Error = TextError;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, TextError> {
        let too_large = || TextError::custom("the number is too large");
        match self.value {
            DeValue::String(text) => visitor.visit_str(text),
            DeValue::Integer(_) => self.integer().ok_or_else(too_large).and_then(|value| visitor.visit_i64(value)),
            DeValue::Float(_) => self.float().ok_or_else(too_large).and_then(|value| visitor.visit_f64(value)),
            DeValue::Boolean(value) => visitor.visit_bool(*value),
            DeValue::Array(entries) => visitor.visit_seq(Entries(entries.iter())),
            DeValue::Table(keys) => visitor.visit_map(Keys::of(keys)),
            DeValue::Datetime(_) => Err(TextError::invalid_type(self.unexpected(), &visitor)),
        }
        .map_err(|error| error.within(&self.span))
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, TextError> {
        visitor.visit_some(self)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(self, _: &'static str, visitor: V) -> Result<V::Value, TextError> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, TextError> {
        match self.value {
            DeValue::Table(keys) => visitor.visit_map(Keys::of(keys)),
            _ => Err(TextError::invalid_type(self.unexpected(), &visitor)),
        }
        .map_err(|error| error.within(&self.span))
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, TextError> {
        match self.value {
            DeValue::String(name) => visitor.visit_enum((&**name).into_deserializer()),
            _ => Err(TextError::invalid_type(self.unexpected(), &"a string")),
        }
        .map_err(|error| error.within(&self.span))
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit unit_struct seq tuple tuple_struct map
        identifier ignored_any
    }
}

struct Entries<'a>(std::slice::Iter<'a, Spanned<DeValue<'a>>>);

impl<'de> SeqAccess<'de> for Entries<'_> {
    type Error = TextError;

    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, TextError> {
        self.0.next().map(|entry| seed.deserialize(Place::from(entry))).transpose()
    }
}

struct Keys<'a> {
    rest: toml::map::Iter<'a, Spanned<DeString<'a>>, Spanned<DeValue<'a>>>,
    value: Option<Place<'a>>,
}

impl<'a> Keys<'a> {
    fn of(table: &'a DeTable<'a>) -> Self {
        Self { rest: table.iter(), value: None }
    }
}

impl<'de> MapAccess<'de> for Keys<'_> {
    type Error = TextError;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, TextError> {
        let Some((key, value)) = self.rest.next() else { return Ok(None) };
        self.value = Some(Place::from(value));
        let name: StrDeserializer<TextError> = (&**key.get_ref()).into_deserializer();
        seed.deserialize(name).map(Some).map_err(|error| error.within(&key.span()))
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, TextError> {
        let value = self.value.take().ok_or_else(|| TextError::custom("a key has no value"))?;
        seed.deserialize(value)
    }
}
