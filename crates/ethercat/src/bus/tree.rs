//! The tree that the cables make, and how long a frame takes to each device.
//!
//! A frame goes through the ports of a device in the order 0, 3, 1, 2, and devices are counted in the
//! order in which they read it. So the tree follows from the open ports alone: every device hangs at
//! the open port that was passed last and leads to nobody yet.
//!
//! Each open port has noted when the frame came in by it. The loop of a device is from port 0 to the
//! last open port: that is how long the frame was behind it. What is left of the time between two
//! ports, less the loop of whom it went to, is the cable there and back:
//!
//! ```text
//! delay(child) = delay(parent) + (t(before) − t(0)) + (t(port) − t(before) − loop(child)) / 2
//! ```
//!
//! where `before` is the open port before the child's, or 0. Times wrap after 4.3 s. Only open ports
//! count: the others keep whatever they had. A device that notes no times is a piece of cable, as long
//! as there is one way on from it.

/// The ports by which a frame goes on, in that order.
const WAYS_ON: [usize; 3] = [3, 1, 2];

/// What a device shows of its ports.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Seen {
    /// By which ports frames go.
    pub(super) open: [bool; 4],
    /// When one came in by each, ns; of no meaning where a port is closed. `None` without such times.
    pub(super) times: Option<[u32; 4]>,
    /// It has a clock, which has to know how late it is.
    pub(super) has_clock: bool,
}

impl Seen {
    fn ways_on(&self) -> impl DoubleEndedIterator<Item = usize> + '_ {
        WAYS_ON.into_iter().filter(|port| self.open[*port])
    }

    /// Whether a frame came in by port 0, and by the others after that.
    fn is_entered_by_port_0(&self) -> bool {
        let Some(times) = self.times else {
            return self.open[0];
        };
        let passed = core::iter::once(0).chain(self.ways_on());
        let times: Vec<u32> = passed.map(|port| times[port]).collect();
        let ascend = |pair: &[u32]| since(pair[1], pair[0]) >= 0;
        self.open[0] && times.windows(2).all(ascend)
    }
}

/// Why delays are not known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Crooked {
    /// No open port leads to this device.
    Loose(usize),
    /// Frames come in to this device by another port than port 0.
    Swapped(usize),
    /// This device joins cables and notes no times, and clocks hang behind it.
    Blind(usize),
}

#[allow(
    clippy::cast_possible_wrap,
    reason = "times wrap, and differences are short"
)]
const fn since(later: u32, earlier: u32) -> i32 {
    later.wrapping_sub(earlier) as i32
}

/// By which port of which device each device hangs; nowhere, the first.
fn hangs(seen: &[Seen]) -> Result<Vec<Option<(usize, usize)>>, Crooked> {
    let mut ways: Vec<(usize, usize)> = Vec::new();
    let mut hangs = Vec::with_capacity(seen.len());
    for (nth, device) in seen.iter().enumerate() {
        let way = ways.pop();
        if way.is_none() && nth > 0 {
            return Err(Crooked::Loose(nth));
        }
        hangs.push(way);
        ways.extend(device.ways_on().rev().map(|port| (nth, port)));
    }
    Ok(hangs)
}

/// How much later than the first device that notes times each one reads a frame, ns; `None` where that
/// is not known.
pub(super) fn delays(seen: &[Seen]) -> Result<Vec<Option<u32>>, Crooked> {
    if let Some(nth) = seen
        .iter()
        .position(|device| !device.is_entered_by_port_0())
    {
        return Err(Crooked::Swapped(nth));
    }
    let hangs = hangs(seen)?;
    let mut delays: Vec<Option<u32>> = Vec::with_capacity(seen.len());
    for (nth, device) in seen.iter().enumerate() {
        let delay = match upwards(seen, &hangs, nth) {
            Ok(way) => way.map_or(Some(0), |(parent, port)| {
                let (above, own) = (seen[parent], device.times?);
                Some(delays[parent]?.saturating_add(way_to(&above, port, loop_of(device, own))?))
            }),
            Err(blind) if device.has_clock => return Err(Crooked::Blind(blind)),
            Err(_) => None,
        };
        delays.push(delay.filter(|_| device.times.is_some()));
    }
    Ok(delays)
}

/// The next device towards the master that notes times, and its port that leads here; `None` if there
/// is none. A device on the way that joins cables and notes no times is an error.
fn upwards(
    seen: &[Seen],
    hangs: &[Option<(usize, usize)>],
    nth: usize,
) -> Result<Option<(usize, usize)>, usize> {
    let mut way = hangs[nth];
    while let Some((parent, _)) = way {
        if seen[parent].times.is_some() {
            break;
        }
        if seen[parent].ways_on().count() > 1 {
            return Err(parent);
        }
        way = hangs[parent];
    }
    Ok(way)
}

/// How long a frame was behind a device.
fn loop_of(device: &Seen, times: [u32; 4]) -> i32 {
    let last = device.ways_on().next_back();
    last.map_or(0, |port| since(times[port], times[0]))
}

/// From port 0 of a device to one that hangs at a port of it, and whose loop is known.
fn way_to(above: &Seen, port: usize, child_loop: i32) -> Option<u32> {
    let times = above.times?;
    let before = above.ways_on().take_while(|way| *way != port).last();
    let before = times[before.unwrap_or(0)];
    // Ports note times in steps: a cable is never shorter than nothing.
    let cable = (since(times[port], before) - child_loop).max(0) / 2;
    u32::try_from(since(before, times[0]) + cable).ok()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests")]

    use super::*;
    use proptest::prelude::*;

    /// A device of a tree that is known: its cables, and what a frame makes of it.
    #[derive(Debug, Clone)]
    struct Known {
        has_times: bool,
        /// From the time of all to its own.
        clock: u32,
        /// By port: who hangs there, and how long the cable is.
        cables: [Option<(usize, u32)>; 4],
        seen: [Option<u32>; 4],
    }

    /// Sends a frame through a device and those behind it; returns when it comes out.
    fn send(tree: &mut [Known], nth: usize, at: u32, ring: &mut Vec<(usize, u32)>) -> u32 {
        ring.push((nth, at));
        let clock = tree[nth].clock;
        tree[nth].seen[0] = Some(at.wrapping_add(clock));
        let mut now = at;
        for port in WAYS_ON {
            if let Some((child, way)) = tree[nth].cables[port] {
                now = send(tree, child, now + way, ring) + way;
                tree[nth].seen[port] = Some(now.wrapping_add(clock));
            }
        }
        now
    }

    fn shown(known: &Known) -> Seen {
        Seen {
            open: known.seen.map(|time| time.is_some()),
            // What a closed port has is anything.
            times: known
                .has_times
                .then(|| known.seen.map(|time| time.unwrap_or(0x686f_6666))),
            has_clock: known.has_times,
        }
    }

    /// Each device: at whom of those that have a port left it hangs, at which of these ports, its cable,
    /// its clock, and whether it notes times (4 of 5 do).
    type Grown = (prop::sample::Index, prop::sample::Index, u32, u32, u8);

    fn grow(devices: &[Grown]) -> Vec<Known> {
        let mut tree: Vec<Known> = Vec::new();
        for (parent, port, way, clock, times) in devices {
            let free: Vec<(usize, usize)> = tree
                .iter()
                .enumerate()
                .filter(|(_, known)| known.has_times || known.cables.iter().all(Option::is_none))
                .flat_map(|(nth, known)| {
                    let free = WAYS_ON.iter().filter(|port| known.cables[**port].is_none());
                    free.map(move |port| (nth, *port))
                })
                .collect();
            let nth = tree.len();
            if nth > 0 {
                let parents: Vec<usize> = free.iter().map(|(nth, _)| *nth).collect();
                let parent = *parent.get(&parents);
                let ports: Vec<_> = free.iter().filter(|(nth, _)| *nth == parent).collect();
                tree[parent].cables[port.get(&ports).1] = Some((nth, *way));
            }
            tree.push(Known {
                has_times: *times > 0,
                clock: *clock,
                cables: [None; 4],
                seen: [None; 4],
            });
        }
        tree
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 3000, ..ProptestConfig::default() })]

        #[test]
        fn a_tree_and_its_delays_follow_from_ports_and_their_times(
            devices in prop::collection::vec(
                (any::<prop::sample::Index>(), any::<prop::sample::Index>(), 0_u32..2000, any::<u32>(), 0_u8..5),
                1..30,
            )
        ) {
            let mut tree = grow(&devices);
            let mut ring = Vec::new();
            send(&mut tree, 0, 0, &mut ring);
            let seen: Vec<Seen> = ring.iter().map(|(nth, _)| shown(&tree[*nth])).collect();
            let found = delays(&seen).unwrap();
            let timed = ring.iter().zip(&seen).find(|(_, seen)| seen.times.is_some());
            let first = timed.map_or(0, |((_, at), _)| *at);
            for (((_, at), seen), found) in ring.iter().zip(&seen).zip(found) {
                prop_assert_eq!(found, seen.times.map(|_| at - first));
            }
        }
    }

    fn seen(ports: &[(usize, u32)]) -> Seen {
        let mut device = Seen {
            open: [false; 4],
            times: Some([0x686f_6666; 4]),
            has_clock: true,
        };
        for (port, time) in ports {
            device.open[*port] = true;
            device.times.as_mut().unwrap()[*port] = *time;
        }
        device
    }

    fn blind(ports: &[usize]) -> Seen {
        let ports: Vec<_> = ports.iter().map(|port| (*port, 0)).collect();
        Seen {
            times: None,
            has_clock: false,
            ..seen(&ports)
        }
    }

    #[test]
    fn a_coupler_and_a_terminal_are_half_a_loop_apart() {
        // An EK1100 with a terminal behind it; another master wrote 300 ns.
        let line = [seen(&[(0, 0xffff_ff00), (1, 0x158)]), seen(&[(0, 7)])];
        assert_eq!(delays(&line).unwrap(), [Some(0), Some(300)]);
    }

    #[test]
    fn a_device_that_notes_no_times_is_cable_until_it_joins_some() {
        let coupler = seen(&[(0, 100), (1, 2100)]);
        let (drive, last) = (seen(&[(0, 50), (1, 650)]), seen(&[(0, 9)]));
        let through = [coupler, blind(&[0, 1]), drive, last];
        let delayed = [Some(0), None, Some(700), Some(1000)];
        assert_eq!(delays(&through).unwrap(), delayed);
        let joins = [coupler, blind(&[0, 1, 3]), last, last];
        assert_eq!(delays(&joins), Err(Crooked::Blind(1)));
        // Nothing there has to know.
        let times = Seen {
            has_clock: false,
            ..last
        };
        let joins = [coupler, blind(&[0, 1, 3]), times, times];
        assert_eq!(delays(&joins).unwrap(), [Some(0), None, None, None]);
    }

    #[test]
    fn cables_that_make_no_tree_are_told_by_the_device() {
        let last = seen(&[(0, 9)]);
        // Entered by port 1, and by port 1 alone.
        let late = seen(&[(0, 700), (1, 100)]);
        assert_eq!(delays(&[late, last]), Err(Crooked::Swapped(0)));
        let closed = seen(&[(1, 100)]);
        let first = seen(&[(0, 0), (1, 1000)]);
        assert_eq!(delays(&[first, closed]), Err(Crooked::Swapped(1)));
        assert_eq!(delays(&[first, last, last]), Err(Crooked::Loose(2)));
    }
}
