//! Path position by time along a path, evaluated exactly.

use crate::on_path::speed::Leg;
use crate::scurve::PathState;

/// Path position by time along some pieces.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Parametrisation {
    /// In order; each begins where the one before ends.
    pub(crate) phases: Vec<MotionPhase>,
    pub(crate) duration_t: f64,
    end: PathState,
    /// The motion whose time the phases are over, in the place of path position.
    nominal: Option<Box<Self>>,
}

/// A part of a time parametrisation on which acceleration changes by constant jerk, or in
/// proportion to path position: one of `jerk_j` and `growth` is zero. With both, [`MotionPhase::at`]
/// would be no solution of ẍ = a₀ + γ·(x − x₀) + J·t.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MotionPhase {
    pub(crate) from_t: f64,
    pub(crate) start: PathState,
    /// Constant jerk, mm/s³.
    pub(crate) jerk_j: f64,
    /// Acceleration gained for each mm, 1/s².
    pub(crate) growth: f64,
}

/// Terms of the series, and the magnitude below which one no longer counts: a hundredth of what rounds
/// the first term, 1.
const MOST_TERMS: u32 = 40;

const SMALLEST_TERM: f64 = 1e-18;

/// Newton steps for the time on a phase, and the change at which they end, s and as a share. The first
/// guess, by the mean of both speeds, is exact for constant acceleration.
const TIME_STEPS: u32 = 20;
const EXACT_T: f64 = 1e-15;
const EXACT_R: f64 = 1e-14;

/// sinh(√γ·t)/√γ and (cosh(√γ·t) − 1)/γ, or their circular likes for γ < 0, by their series: the
/// functions themselves lose digits where γ is near 0, and would be two cases.
fn series(growth: f64, t: f64) -> (f64, f64) {
    let z = growth * t * t;
    let (mut first, mut second) = (1.0, 0.5);
    let (mut odd, mut even) = (1.0, 0.5);
    for k in 1..MOST_TERMS {
        let n = f64::from(2 * k);
        odd *= z / (n * (n + 1.0));
        even *= z / ((n + 1.0) * (n + 2.0));
        first += odd;
        second += even;
        if odd.abs() < SMALLEST_TERM {
            break;
        }
    }
    (first * t, second * t * t)
}

impl MotionPhase {
    /// The state `t` after the start of the phase.
    pub(crate) fn at(&self, t: f64) -> PathState {
        // The solution of ẍ = a₀ + γ·(x − x₀) or, with γ = 0, of a constant jerk. For γ > 0 `zeroth` is
        // cosh √γ·t, and `first` and `second` are its integrals.
        let PathState {
            position_s,
            speed_v,
            accel_a,
        } = self.start;
        let (first, second) = series(self.growth, t);
        let (zeroth, jerk_j) = (1.0 + self.growth * second, self.jerk_j);
        PathState {
            position_s: position_s + speed_v * first + accel_a * second + jerk_j * t * t * t / 6.0,
            speed_v: speed_v * zeroth + accel_a * first + 0.5 * jerk_j * t * t,
            accel_a: accel_a * zeroth + self.growth * speed_v * first + jerk_j * t,
        }
    }

    /// The state at a path position, on a phase on which v² is a parabola.
    pub(crate) fn at_position(&self, position_s: f64) -> PathState {
        let (passed_s, start) = (position_s - self.start.position_s, &self.start);
        // b − b₀ = b′·x + ½·b″·x², with b′ = 2·a₀ and b″ = 2·γ.
        let gained = passed_s * (2.0 * start.accel_a + self.growth * passed_s);
        PathState {
            position_s,
            speed_v: (start.speed_v * start.speed_v + gained).max(0.0).sqrt(),
            accel_a: start.accel_a + self.growth * passed_s,
        }
    }
}

impl Parametrisation {
    /// Memory that it keeps beside its own, bytes.
    pub(crate) fn heap_bytes(&self) -> usize {
        let beside = self.nominal.as_deref();
        self.phases.capacity() * size_of::<MotionPhase>()
            + beside.map_or(0, |nominal| size_of_val(nominal) + nominal.heap_bytes())
    }

    /// The same motion as some S-curves, slowed down: `rate_r` ≤ 1 times as fast. Acceleration goes
    /// with the square of that, jerk with its cube.
    pub(crate) fn slowed(legs: &[Leg], rate_r: f64) -> Option<Self> {
        let mut phases: Vec<MotionPhase> = Vec::new();
        let mut from_t = 0.0;
        for leg in legs {
            for (duration_t, start, jerk_j) in leg.profile.phases() {
                if duration_t <= 0.0 {
                    continue;
                }
                phases.push(MotionPhase {
                    from_t,
                    start: PathState {
                        position_s: leg.from_s + start.position_s,
                        speed_v: start.speed_v * rate_r,
                        accel_a: start.accel_a * rate_r * rate_r,
                    },
                    jerk_j: jerk_j * rate_r.powi(3),
                    growth: 0.0,
                });
                from_t += duration_t / rate_r;
            }
        }
        let last = legs.last()?;
        let end = PathState {
            position_s: last.from_s + last.profile.length_s(),
            speed_v: last.profile.exit_v() * rate_r,
            accel_a: 0.0,
        };
        Some(Self {
            phases,
            duration_t: from_t,
            end,
            nominal: None,
        })
    }

    /// How long the motion takes, s.
    pub(crate) const fn duration_t(&self) -> f64 {
        self.duration_t
    }

    /// The path it covers, mm.
    pub(crate) const fn length_s(&self) -> f64 {
        self.end.position_s
    }

    /// The speed at its end, mm/s.
    pub(crate) const fn exit_v(&self) -> f64 {
        self.end.speed_v
    }

    /// The state `t` after the start, held after the end.
    pub(crate) fn at(&self, t: f64) -> PathState {
        if t >= self.duration_t {
            return self.end;
        }
        let index = self.phases.partition_point(|phase| phase.from_t <= t);
        let own = match self.phases.get(index.saturating_sub(1)) {
            Some(phase) => phase.at(t - phase.from_t),
            None => return self.end,
        };
        let Some(nominal) = &self.nominal else {
            return own;
        };
        let (rate_r, rise) = (own.speed_v, own.accel_a);
        let there = nominal.at(own.position_s);
        PathState {
            position_s: there.position_s,
            speed_v: there.speed_v * rate_r,
            accel_a: there.accel_a * rate_r * rate_r + there.speed_v * rise,
        }
    }
}

/// Puts phases one after the other.
pub(crate) struct Builder {
    parametrisation: Parametrisation,
}

impl Builder {
    pub(crate) const fn new() -> Self {
        let end = PathState {
            position_s: 0.0,
            speed_v: 0.0,
            accel_a: 0.0,
        };
        Self {
            parametrisation: Parametrisation {
                phases: Vec::new(),
                duration_t: 0.0,
                end,
                nominal: None,
            },
        }
    }

    /// A phase of constant jerk.
    pub(crate) fn push_phase(&mut self, start: PathState, jerk_j: f64, duration_t: f64) {
        let from_t = self.parametrisation.duration_t;
        self.parametrisation.phases.push(MotionPhase {
            from_t,
            start,
            jerk_j,
            growth: 0.0,
        });
        self.parametrisation.duration_t += duration_t;
    }

    /// A phase on which b = v² is a parabola: from a state over a length, b″ its second derivative.
    /// `None` if the motion does not get through.
    pub(crate) fn push_parabola(
        &mut self,
        start: PathState,
        length_s: f64,
        second: f64,
    ) -> Option<()> {
        // a = b′/2, so da/ds = b″/2: ẍ = a₀ + γ·(x − x₀) with γ = b″/2.
        let growth = 0.5 * second;
        let phase = MotionPhase {
            from_t: self.parametrisation.duration_t,
            start,
            jerk_j: 0.0,
            growth,
        };
        // b at the end, for a first guess of the time at the mean of both speeds.
        let left_b =
            start.speed_v * start.speed_v + length_s * (2.0 * start.accel_a + growth * length_s);
        let sum_v = start.speed_v + left_b.max(0.0).sqrt();
        let mut t = 2.0 * length_s / sum_v;
        for _ in 0..TIME_STEPS {
            let state = phase.at(t);
            let step_t = (state.position_s - start.position_s - length_s) / state.speed_v;
            t -= step_t;
            if step_t.abs() <= EXACT_T + EXACT_R * t {
                break;
            }
        }
        let is_through = t > 0.0 && t.is_finite();
        if is_through {
            self.parametrisation.phases.push(phase);
            self.parametrisation.duration_t += t;
        }
        is_through.then_some(())
    }

    /// What the phases make, up to its end. `nominal`: the motion whose time they are over, if they are not over
    /// path position.
    pub(crate) fn finish(
        mut self,
        end: PathState,
        nominal: Option<Parametrisation>,
    ) -> Parametrisation {
        self.parametrisation.end = end;
        self.parametrisation.nominal = nominal.map(Box::new);
        self.parametrisation
    }
}
