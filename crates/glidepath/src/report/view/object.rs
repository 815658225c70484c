//! The view for other programs.

use super::seen::View;
use crate::report::auxiliary::{coolant_words, spindle_words};
use crate::report::machine::names;
use serde_json::{Map, Value, json};

/// What a view tells besides its status, as an object.
#[must_use]
pub fn view_object(view: &View<'_>) -> Map<String, Value> {
    let place = view.place.as_ref();
    let offset = view.offsets.as_ref();
    let [offset, work] = offset.map_or([Value::Null, Value::Null], |offset| {
        offset.objects(&view.status.position, view.axes)
    });
    let object = json!({
        "updated_ns": view.status.updated_ns,
        "program": place.map(|place| place.program.as_str()),
        "block_text": place.map(|place| place.text.as_str()),
        "progress": view.progress(),
        "planned_s": place.and_then(|place| place.planned_t),
        "left_s": view.left_t(),
        "tool": view.auxiliary.map(|record| record.tool),
        "tool_selected": view.auxiliary.map(|record| record.prepared_tool),
        "spindle": view.auxiliary.map(spindle_words),
        "coolant": view.auxiliary.map(coolant_words),
        "axes_not_homed": names(view.not_homed),
        "offset": offset,
        "work_position": work,
        "events": view.events.iter()
            .map(|(ago, text)| json!({ "ago_s": ago.as_secs_f64(), "text": text }))
            .collect::<Vec<_>>(),
    });
    match object {
        Value::Object(object) => object,
        _ => Map::new(),
    }
}
