//! The functions for texts of states and faults: those that `glidepath status` shows.

use super::call::call;
use super::pointer::{Given, Room, check_size};
use crate::failure::Failure;
use core::ffi::c_char;
use glidepath_link::{FaultCause, MachineState, Status, printable};

const NO_STATUS: &str = "status: NULL, or not aligned";

/// Gives the caller a text; returns the length of all of it.
fn tell(told: &str, text: &Room<c_char>, size: usize) -> i32 {
    let told = printable(told);
    text.put_text(told.as_bytes(), size);
    // Texts of records are bounded far below that.
    i32::try_from(told.len()).unwrap_or(i32::MAX)
}

#[unsafe(no_mangle)]
extern "C" fn gp_state_text(state: u32, text: Room<c_char>, size: usize) -> i32 {
    call(|| {
        let state = MachineState::from_code(state);
        let state = state.ok_or(Failure::Argument("state: no GP_STATE_"))?;
        Ok(tell(state.text(), &text, size))
    })
}

#[unsafe(no_mangle)]
extern "C" fn gp_fault_text(
    status: Given<Status>,
    status_size: usize,
    text: Room<c_char>,
    size: usize,
) -> i32 {
    call(|| {
        check_size::<Status>("gp_status", status_size)?;
        let told = status.get(NO_STATUS)?.fault_text();
        Ok(tell(&told.unwrap_or_default(), &text, size))
    })
}

#[unsafe(no_mangle)]
extern "C" fn gp_fault_remedy(
    status: Given<Status>,
    status_size: usize,
    text: Room<c_char>,
    size: usize,
) -> i32 {
    call(|| {
        check_size::<Status>("gp_status", status_size)?;
        let cause = status.get(NO_STATUS)?.fault()?;
        let told = cause.map(FaultCause::remedy);
        Ok(tell(told.unwrap_or_default(), &text, size))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::failure::Code;
    use bytemuck::Zeroable as _;
    use glidepath_link::FaultCause;

    /// What a function gives that takes room for a text.
    fn told(give: impl Fn(Room<c_char>, usize) -> i32) -> Result<String, i32> {
        let length = give(Room::nowhere(), 0);
        let size = usize::try_from(length).map_err(|_| length)? + 1;
        let mut room = vec![0_u8; size];
        assert_eq!(give(Room::at(&mut room), size), length);
        assert_eq!(room.pop(), Some(0), "it is ended");
        Ok(String::from_utf8(room).unwrap())
    }

    #[test]
    fn texts_are_those_of_the_status() {
        for state in MachineState::ALL {
            let text = told(|text, size| gp_state_text(state.code(), text, size));
            assert_eq!(text.as_deref(), Ok(state.text()));
        }
        let none = told(|text, size| gp_state_text(99, text, size));
        assert_eq!(none, Err(Code::Argument as i32));
        let mut status = Status::zeroed();
        let size_of = size_of::<Status>();
        for cause in FaultCause::all() {
            status.fault = cause.code();
            status.fault_line = 7;
            let text =
                told(|text, size| gp_fault_text(Given::of(&status), size_of, text, size)).unwrap();
            assert_eq!(Some(text), status.fault_text());
            let remedy =
                told(|text, size| gp_fault_remedy(Given::of(&status), size_of, text, size));
            assert_eq!(remedy.as_deref(), Ok(cause.remedy()));
        }
        status.fault = 0;
        let text = told(|text, size| gp_fault_text(Given::of(&status), size_of, text, size));
        assert_eq!(text.as_deref(), Ok(""));
        let short = told(|text, size| gp_fault_text(Given::of(&status), 8, text, size));
        assert_eq!(short, Err(Code::Abi as i32));
    }
}
