//! The functions for the servo: demands at any time, and a stop of its own.

use super::call::{NONE, call, code_of};
use super::handle::{Handle, Held};
use super::link::Link;
use super::pointer::{Given, Room, check_size};
use crate::layout::{GpJoint, GpServoSettings, GpServoState};
use crate::servo::{RingServo, default_settings};
use glidepath_geometry::AXES;
use glidepath_link::Setpoint;

impl Held for RingServo {
    const MARK: u32 = 0x7365_7276;
    const NAME: &'static str = "the servo";
    const NO_HANDLE: &'static str = "servo: no open gp_servo";
    const MAY_MOVE: bool = true;
}

const NO_HANDLE_ROOM: &str = "servo: NULL, where the handle is to go";
const NO_SETTINGS: &str = "settings: NULL";
const NO_SETPOINT: &str = "setpoint: not aligned";
const NO_JOINTS: &str = "joints: NULL, where they are to go";

#[unsafe(no_mangle)]
extern "C" fn gp_servo_settings_default(settings: Room<GpServoSettings>, size: usize) -> i32 {
    call(|| {
        check_size::<GpServoSettings>("gp_servo_settings", size)?;
        settings.put(default_settings(), NO_SETTINGS)?;
        Ok(NONE)
    })
}

#[unsafe(no_mangle)]
extern "C" fn gp_servo_open(
    link: Handle<Link>,
    settings: Given<GpServoSettings>,
    size: usize,
    servo: Room<Handle<RingServo>>,
) -> i32 {
    link.with(|link| {
        check_size::<GpServoSettings>("gp_servo_settings", size)?;
        servo.check(NO_HANDLE_ROOM)?;
        let settings = settings.get(NO_SETTINGS)?;
        let handle = Handle::open(RingServo::open(&link.config, &settings)?);
        servo.put(handle, NO_HANDLE_ROOM)?;
        Ok(NONE)
    })
}

#[unsafe(no_mangle)]
extern "C" fn gp_servo_receive(
    servo: Handle<RingServo>,
    now_ns: u64,
    setpoint: Room<Setpoint>,
    size: usize,
) -> i32 {
    servo.with(|servo| {
        if !setpoint.is_null() {
            check_size::<Setpoint>("gp_setpoint", size)?;
            setpoint.check(NO_SETPOINT)?;
        }
        let received = servo.receive(now_ns)?;
        if let Some(received) = received
            && !setpoint.is_null()
        {
            setpoint.put(received, NO_SETPOINT)?;
        }
        Ok(code_of(received.is_some()))
    })
}

#[unsafe(no_mangle)]
extern "C" fn gp_servo_demand(
    servo: Handle<RingServo>,
    now_ns: u64,
    joints: Room<[GpJoint; AXES]>,
    size: usize,
) -> i32 {
    servo.with(|servo| {
        check_size::<[GpJoint; AXES]>("gp_joint[GP_AXES]", size)?;
        joints.check(NO_JOINTS)?;
        let demand = servo.demand(now_ns);
        if let Some(demand) = demand {
            joints.put(demand, NO_JOINTS)?;
        }
        Ok(code_of(demand.is_some()))
    })
}

#[unsafe(no_mangle)]
extern "C" fn gp_servo_stop(servo: Handle<RingServo>, now_ns: u64) -> i32 {
    servo.with(|servo| {
        servo.stop(now_ns);
        Ok(NONE)
    })
}

#[unsafe(no_mangle)]
extern "C" fn gp_servo_rearm(servo: Handle<RingServo>) -> i32 {
    servo.with(|servo| {
        servo.rearm();
        Ok(NONE)
    })
}

#[unsafe(no_mangle)]
extern "C" fn gp_servo_rearm_at(
    servo: Handle<RingServo>,
    actual: Given<[f64; AXES]>,
    window: Given<[f64; AXES]>,
) -> i32 {
    servo.with(|servo| {
        let actual = actual.get("actual: NULL, where the joints stand")?;
        let window = window.get("window: NULL, how near setpoints have to be")?;
        servo.rearm_at(&actual, &window)?;
        Ok(NONE)
    })
}

#[unsafe(no_mangle)]
extern "C" fn gp_servo_read_state(
    servo: Handle<RingServo>,
    state: Room<GpServoState>,
    size: usize,
) -> i32 {
    servo.with(|servo| {
        check_size::<GpServoState>("gp_servo_state", size)?;
        state.put(servo.state(), "state: NULL, where it is to go")?;
        Ok(NONE)
    })
}

#[unsafe(no_mangle)]
extern "C" fn gp_servo_release(servo: Handle<RingServo>) -> i32 {
    servo.release()
}

#[unsafe(no_mangle)]
extern "C" fn gp_servo_close(servo: Handle<RingServo>) -> i32 {
    servo.close(|servo| Ok(servo.close()?))
}
