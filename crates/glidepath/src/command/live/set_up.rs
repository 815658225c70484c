//! The set-up of the machine as pages are told: work offsets, tools, joints, and how it may be
//! jogged.

use super::super::tool_names::ToolNames;
use crate::config::{HomingBy, MachineConfig};
use crate::persistence::convert::system_name;
use crate::persistence::read::{read, set_up, table};
use glidepath_gcode::Connections;
use glidepath_geometry::AXES;
use glidepath_persistence::PersistentState;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Between two looks at what is kept.
const EVERY: Duration = Duration::from_millis(500);
/// Tools that are listed.
const MOST_TOOLS: usize = 1000;

/// What pages are told of it, looked at now and then.
pub(super) struct SetUp {
    config: MachineConfig,
    names: ToolNames,
    known: Mutex<Option<(Instant, u64, Value)>>,
}

impl SetUp {
    pub(super) fn new(config: &MachineConfig) -> Self {
        Self {
            names: ToolNames::new(config),
            config: config.clone(),
            known: Mutex::default(),
        }
    }

    /// A number that is another one when offsets or tools are others.
    pub(super) fn version(&self) -> u64 {
        self.look().0
    }

    /// How the machine is set up, as `/api/set-up` tells.
    pub(super) fn object(&self) -> Value {
        self.look().1
    }

    fn look(&self) -> (u64, Value) {
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((looked, version, object)) = &*known
            && looked.elapsed() < EVERY
        {
            return (*version, object.clone());
        }
        let object = self.read();
        let mut hash = DefaultHasher::new();
        object.to_string().hash(&mut hash);
        // Pages count in numbers that are exact up to 2^53.
        let version = hash.finish() >> 12;
        *known = Some((Instant::now(), version, object.clone()));
        (version, object)
    }

    fn read(&self) -> Value {
        let config = &self.config;
        let mut machine = config.clone();
        let (kept, trouble) = match read(config) {
            Ok(kept) => (kept, None),
            Err(error) => (None, Some(error.to_string())),
        };
        if let Some(kept) = &kept {
            set_up(&mut machine, kept);
        }
        let velocity = config.axis_names().into_iter().map(|axis| {
            let v = config.jog.velocity.get(axis.index()).copied();
            (axis.to_string(), (v.unwrap_or(0.0) * 60.0).into())
        });
        // Where joints are not axes, none is of one.
        let axes = config.axis_of_joints();
        let axes = axes.iter().filter(|_| config.joints() == 0);
        let mut axes = axes.map(ToString::to_string);
        let joints: Vec<Option<String>> = (0..config.drives()).map(|_| axes.next()).collect();
        json!({
            "keeps": config.state_directory.is_some(),
            "trouble": trouble,
            "active": kept.as_ref().map(|kept| system_name(kept.offsets.active)),
            "systems": kept.as_ref().map(|kept| self.systems(kept)),
            "spindle_tool": kept.as_ref().map(|kept| kept.spindle_tool),
            "tools": self.tools(&machine),
            "jog": {
                "velocity": velocity.collect::<Map<String, Value>>(),
                "unhomed_velocity": config.jog.unhomed_velocity * 60.0,
                "increments": config.jog.increments,
                "dead_man_ms": config.jog.dead_man_ms,
            },
            "probe": self.probe(),
            "joints": joints,
            "power": config.feedback.is_expected,
            "homing": match config.feedback.homing {
                HomingBy::Nobody => "none",
                _ => "wanted",
            },
        })
    }

    /// The probe; null if there is none. Of one that only simulates nothing can be learnt of the part.
    fn probe(&self) -> Value {
        let is_real = self.config.program.connections == Connections::Real;
        let most_v = self.config.probing_v().filter(|_| is_real);
        most_v.map_or(Value::Null, |v| json!({ "most_mm_min": v * 60.0 }))
    }

    fn by_axis(&self, values: &[f64; AXES]) -> Map<String, Value> {
        let axes = self.config.axis_names().into_iter();
        axes.filter_map(|axis| Some((axis.to_string(), (*values.get(axis.index())?).into())))
            .collect()
    }

    fn systems(&self, kept: &PersistentState) -> Value {
        let systems = (1..).zip(&kept.offsets.systems);
        let object = |(number, system): (u8, &glidepath_persistence::System)| {
            json!({
                "name": system_name(number),
                "number": number,
                "origin": self.by_axis(&system.origin),
                "rotation_deg": system.rotation_deg,
            })
        };
        systems.map(object).collect()
    }

    fn tools(&self, machine: &MachineConfig) -> Value {
        let (tools, names) = (table(machine), self.names.all());
        let by_axis = |tool: &glidepath_gcode::Tool| {
            let mut offset = [0.0; AXES];
            for (slot, value) in offset.iter_mut().zip(tool.offset.iter()) {
                *slot = *value;
            }
            self.by_axis(&offset)
        };
        let mut further: BTreeMap<u32, Vec<Value>> = BTreeMap::new();
        for (number, edge, tool) in tools.edges().filter(|(_, edge, _)| *edge != 1) {
            further.entry(number).or_default().push(json!({
                "edge": edge,
                "diameter_mm": tool.diameter_mm,
                "offset": by_axis(tool),
            }));
        }
        let mut object = |(number, tool): (u32, &glidepath_gcode::Tool)| {
            let mut object = json!({
                "number": number,
                "name": names.get(&number),
                "diameter_mm": tool.diameter_mm,
                "offset": by_axis(tool),
            });
            if let Some(edges) = further.remove(&number) {
                object["edges"] = edges.into();
            }
            object
        };
        tools.tools().take(MOST_TOOLS).map(&mut object).collect()
    }
}
