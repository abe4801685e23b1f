//! The JSON Schema of robot files, for editors.

use super::format::{Angle, At, Pair, Plain, Range, RobotFile};
use crate::legs::{Facts, Kind};
use schemars::generate::SchemaSettings;
use schemars::transform::RecursiveTransform;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::Value;
use std::borrow::Cow;

/// The schema, made from the types that read the files.
pub(super) fn schema() -> Schema {
    let settings = SchemaSettings::draft2020_12().with_transform(RecursiveTransform(without_null));
    settings.into_generator().into_root_schema_for::<RobotFile>()
}

/// TOML has no null: a key that may be missing is just not required.
fn without_null(schema: &mut Schema) {
    if let Some(Value::Array(types)) = schema.get("type")
        && let [one, null] = types.as_slice()
        && null == "null"
    {
        let one = one.clone();
        schema.insert("type".into(), one);
    }
    if let Some(Value::Array(options)) = schema.get("anyOf")
        && let [one, null] = options.as_slice()
        && null["type"] == "null"
        && let Some(reference) = one.get("$ref").cloned()
    {
        schema.remove("anyOf");
        schema.insert("$ref".into(), reference);
    }
}

impl<T: JsonSchema> JsonSchema for At<T> {
    fn inline_schema() -> bool {
        T::inline_schema()
    }
    fn schema_name() -> Cow<'static, str> {
        T::schema_name()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        T::json_schema(generator)
    }
}

impl JsonSchema for Plain {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "number".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "number" })
    }
}

impl JsonSchema for Pair {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "pair".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        <[Plain; 2]>::json_schema(generator)
    }
}

impl<T: JsonSchema> JsonSchema for Angle<T> {
    fn schema_name() -> Cow<'static, str> {
        if T::schema_name() == Plain::schema_name() { "Angle" } else { "AngleRange" }.into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let value = generator.subschema_for::<T>();
        json_schema!({
            "description": "An angle (or a range of angles) with its unit.",
            "oneOf": [
                { "type": "object", "properties": { "deg": value }, "required": ["deg"], "additionalProperties": false },
                { "type": "object", "properties": { "rad": value }, "required": ["rad"], "additionalProperties": false },
            ]
        })
    }
}

impl JsonSchema for Range {
    fn schema_name() -> Cow<'static, str> {
        "Range".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let (length, angle) = (generator.subschema_for::<Pair>(), generator.subschema_for::<Angle<Pair>>());
        json_schema!({
            "description": "[min, max] of a length, or { deg = [min, max] } of an angle.",
            "anyOf": [length, angle]
        })
    }
}

/// In the schema, each kind requires its keys and takes no others (a planar leg may do without those that say
/// how it stands in space; the schema does not know the platform).
pub(super) fn keys_of_each_kind(schema: &mut Schema) {
    let all: Vec<String> = schema
        .get("properties")
        .and_then(|p| p.as_object())
        .map(|p| p.keys().filter(|k| *k != "kind").cloned().collect())
        .unwrap_or_default();
    let rules = Kind::ALL.iter().map(|kind| {
        let Facts { name, planar_keys: required, spatial_keys: taken, .. } = kind.facts();
        let refused: serde_json::Map<_, _> =
            all.iter().filter(|k| !taken.contains(&k.as_str())).map(|k| (k.clone(), false.into())).collect();
        serde_json::json!({
            "if": { "properties": { "kind": { "const": name } } },
            "then": { "required": required, "properties": refused }
        })
    });
    schema.insert("allOf".into(), rules.collect());
}
