//! The source of items of a program text, and of files of them, which are checked as a whole before
//! anything moves.

use std::io::{self, BufRead, BufReader, Seek};
use std::path::Path;

use glidepath_gcode::{
    Diagnostic, InForce, InputWait, Lacking, Options, PositionOffsets, Probed, Program,
    Subroutines, diagnostics,
};
use glidepath_program::{Event, Item, ItemKind};

use crate::run::refusal::Refusal;
use crate::source::changes::{ChangeLog, PositionOffsetsLog, SetUp};
use crate::source::fingerprint::Fingerprinting;
use crate::source::input_arbiter::{AnsweredInput, InputArbiter, InputRequest, InputResult};
use crate::source::item_source::{ItemSource, Settled, Supply};
use crate::source::remarks::RemarkLog;
use crate::source::run_channels::RunChannels;
use crate::source::unchanged_file::UnchangedFile;

/// Bytes read from a file or pipe at a time.
pub(crate) const BUFFER: usize = 64 * 1024;

/// Items of a program text, read as they are wanted.
#[derive(Debug)]
pub struct ProgramSource<R> {
    program: Program<R>,
    fingerprint: u64,
    /// Items handed over.
    given: u32,
    /// Where changes of how the machine is set up are noted, and how many of them were.
    log: Option<(ChangeLog, u64)>,
    /// Where the length of the tool in force is noted, and what was noted last.
    position_offsets: Option<(PositionOffsetsLog, Option<PositionOffsets>)>,
    remarks: Option<RemarkLog>,
    /// Where inputs are asked.
    inputs: Option<InputArbiter>,
    /// What the M66 given out last asks, with its line.
    wait: Option<(u32, InputWait)>,
    /// The desk was asked, and has not answered.
    asking: bool,
    /// How the probing move ended that was answered last, until it is taken.
    probed: Option<Probed>,
}

impl<R: BufRead> ProgramSource<R> {
    /// A program that is not checked beforehand: its first error ends it.
    #[must_use]
    pub fn new(reader: R, options: Options) -> Self {
        Self {
            program: Program::new(reader, options),
            fingerprint: 0,
            given: 0,
            log: None,
            position_offsets: None,
            remarks: None,
            inputs: None,
            wait: None,
            asking: false,
            probed: None,
        }
    }

    /// The same source, of a program whose fingerprint is known: it was opened before, and is read once more.
    #[must_use]
    pub(crate) const fn known_as(mut self, fingerprint: u64) -> Self {
        self.fingerprint = fingerprint;
        self
    }

    /// A program whose lines come one after the other: [`Program::typed`].
    pub(crate) fn typed(reader: R, options: Options) -> Self {
        let source = Self::new(reader, options);
        Self {
            program: source.program.typed(),
            ..source
        }
    }

    pub(crate) const fn program(&self) -> &Program<R> {
        &self.program
    }

    /// Whether nothing is read before an input, or the probe, was looked at.
    pub(crate) const fn is_asking(&self) -> bool {
        self.asking
    }

    /// How the probing move ended that was answered last, once.
    pub(crate) const fn take_probed(&mut self) -> Option<Probed> {
        self.probed.take()
    }

    /// The same source, which shares what it comes to with whoever attends to its run.
    #[must_use]
    pub fn attended(self, channels: RunChannels) -> Self {
        let RunChannels {
            changes,
            position_offsets,
            remarks,
            inputs,
        } = channels;
        let program = if remarks.is_some() {
            self.program.with_remarks()
        } else {
            self.program
        };
        Self {
            program,
            remarks,
            inputs,
            log: changes.map(|log| (log, 0)),
            position_offsets: position_offsets.map(|log| (log, None)),
            ..self
        }
    }

    /// The state in force behind the items given out.
    #[must_use]
    pub fn in_force(&self) -> InForce {
        self.program.in_force()
    }

    /// What is asked behind the item given out last. Whoever only looks at a program asks nothing,
    /// and goes on as if probing moves went to their ends.
    fn request(&self) -> Option<(u32, InputRequest)> {
        let wait = self
            .wait
            .map(|(line, wait)| (line, InputRequest::Input(wait)));
        let probe = || {
            let is_at_probe = self.program.is_at_probe();
            is_at_probe.then(|| (self.program.line_of_last(), InputRequest::Probe))
        };
        self.inputs.as_ref().and_then(|_| wait.or_else(probe))
    }

    /// What is asked, as it was answered when the program came here before.
    fn recall(&mut self) -> Result<Settled, Refusal> {
        let (Some(arbiter), Some((line, request))) = (&self.inputs, self.request()) else {
            return Ok(Settled::Nothing);
        };
        let Some(AnsweredInput { line: of, answer }) = arbiter.recall() else {
            return Ok(Settled::Open);
        };
        let fits = matches!(answer, InputResult::Probe(_)) == (request == InputRequest::Probe);
        if of != line || !fits {
            return Err(Refusal::AnswerUnknown { line });
        }
        self.tell(answer)?;
        Ok(Settled::Answered(answer))
    }

    /// Asks what is to be asked, and takes what was answered. `None` if all is known.
    fn ask(&mut self) -> Result<Option<Supply>, Refusal> {
        if self.asking {
            let Some(answer) = self.inputs.as_ref().and_then(InputArbiter::take_answer) else {
                return Ok(Some(Supply::Pending));
            };
            self.tell(answer)?;
            return Ok(None);
        }
        if self.recall()? != Settled::Open {
            return Ok(None);
        }
        let (Some(arbiter), Some((line, request))) = (&self.inputs, self.request()) else {
            return Ok(None);
        };
        arbiter.ask(line, request);
        self.asking = true;
        Ok(Some(match request {
            InputRequest::Input(_) => Supply::Pending,
            InputRequest::Probe => Supply::Probe,
        }))
    }

    fn tell(&mut self, answer: InputResult) -> Result<(), Refusal> {
        (self.asking, self.wait) = (false, None);
        match answer {
            InputResult::Input(value) => self.program.answer_input(value),
            InputResult::Probe(probed) => {
                self.probed = Some(probed);
                let ended = self.program.answer_probe(&probed);
                ended.map_err(|diagnostic| refused(*diagnostic))?;
            }
        }
        Ok(())
    }

    fn note_remarks(&mut self) {
        if let Some(log) = &self.remarks {
            for remark in self.program.take_remarks() {
                log.note(self.given, remark);
            }
        }
    }

    /// Notes what was changed in front of the item that is about to be handed over.
    fn note_changes(&mut self) {
        let set_up = Self::set_up;
        if let Some((log, noted)) = &mut self.log
            && *noted != self.program.changes()
        {
            *noted = self.program.changes();
            log.note(self.given, set_up(&self.program));
        }
    }

    /// Notes the offsets that hold from the item on that is about to be handed over. The blocks of
    /// a line are handed over one after the other, and its G43 counts behind its M6.
    fn note_position_offsets(&mut self, next: Option<&Item>) {
        let is_before_the_tool = next.is_some_and(|item| {
            matches!(
                item.kind,
                ItemKind::Event(
                    Event::SpindleSpeed(_) | Event::SelectTool(_) | Event::MCode(6 | 61)
                )
            )
        });
        if let Some((log, noted)) = &mut self.position_offsets
            && !is_before_the_tool
        {
            let offsets = self.program.position_offsets();
            if noted.replace(offsets) != Some(offsets) {
                log.note(self.given, offsets);
            }
        }
    }

    /// Notes that the item handed over last puts another tool into the spindle.
    fn note_tool(&self) {
        if let Some((log, _)) = &self.log {
            log.note(self.given, Self::set_up(&self.program));
        }
    }

    fn set_up(program: &Program<R>) -> SetUp {
        SetUp {
            offsets: program.work_offsets(),
            tools: program.tools().cloned(),
            tool: program.tool(),
            variables: program.kept_variables(),
        }
    }
}

impl ProgramSource<BufReader<UnchangedFile>> {
    /// Opens a file after a pass over the whole of it. Should the file change after that, an error
    /// ends the motion as it does with a pipe.
    ///
    /// # Errors
    /// All diagnostics, if there is any; that the program could not be checked to its end, unless
    /// it may be run all the same; or why the file cannot be read.
    pub fn open(path: &Path, options: Options) -> Result<Self, Refusal> {
        Self::look(path, options)?.2
    }

    /// The fingerprint of a file, what it lacks, and the same as [`Self::open`].
    ///
    /// # Errors
    /// The file cannot be read.
    pub(crate) fn look(
        path: &Path,
        options: Options,
    ) -> io::Result<(u64, Lacking, Result<Self, Refusal>)> {
        let mut file = UnchangedFile::open(path)?;
        let mut reader = Fingerprinting::new(&mut file);
        let found = diagnostics(
            BufReader::with_capacity(BUFFER, &mut reader),
            options.clone(),
        );
        // What stands behind the end of the program, or what was not reached, belongs to the text.
        io::copy(&mut reader, &mut io::sink())?;
        // The subroutines it calls in other files belong to the program.
        for (name, file) in options.subroutines.iter().flat_map(Subroutines::read) {
            reader.add(name.as_bytes());
            reader.add(&file.text);
        }
        let fingerprint = reader.fingerprint();
        let may_run = options.loops.may_run_unchecked;
        let refusal = if !found.diagnostics.is_empty() {
            Some(Refusal::Program {
                diagnostics: found.diagnostics,
                unlisted: found.more,
            })
        } else {
            let given_up_at = found.given_up_at.filter(|_| !may_run);
            given_up_at.map(|line| Refusal::Unchecked { line })
        };
        if let Some(refusal) = refusal {
            return Ok((fingerprint, found.lacks, Err(refusal)));
        }
        file.rewind()?;
        let source = Self {
            fingerprint,
            ..Self::new(BufReader::with_capacity(BUFFER, file), options)
        };
        Ok((fingerprint, found.lacks, Ok(source)))
    }
}

impl<R: BufRead> ItemSource for ProgramSource<R> {
    fn next_item(&mut self) -> Supply {
        match self.ask() {
            Ok(None) => {}
            Ok(Some(supply)) => return supply,
            Err(refusal) => return Supply::Refused(refusal),
        }
        let next = self.program.next();
        self.note_changes();
        self.note_position_offsets(next.as_ref().and_then(|next| next.as_ref().ok()));
        self.note_remarks();
        match next {
            Some(Ok(item)) => {
                self.given = self.given.saturating_add(1);
                if matches!(item.kind, ItemKind::Event(Event::MCode(6 | 61))) {
                    self.note_tool();
                }
                if item.kind == ItemKind::Event(Event::MCode(66)) {
                    self.wait = self.program.take_input_wait().map(|wait| (item.line, wait));
                }
                Supply::Item(item)
            }
            Some(Err(diagnostic)) => Supply::Refused(refused(diagnostic)),
            // It waits for lines.
            None if !self.program.has_ended() => Supply::Pending,
            None => Supply::End,
        }
    }

    fn settle(&mut self, known: Option<InputResult>) -> Result<Settled, Refusal> {
        let settled = self.recall()?;
        let (Settled::Open, Some(answer)) = (settled, known) else {
            return Ok(settled);
        };
        if let (Some(arbiter), Some((line, request))) = (&self.inputs, self.request()) {
            arbiter.ask(line, request);
            arbiter.answer(answer).map_err(Refusal::NotKept)?;
            arbiter.take_answer();
        }
        self.tell(answer)?;
        Ok(Settled::Answered(answer))
    }

    fn lines_read(&self) -> u64 {
        u64::from(self.program.totals().lines)
    }

    fn fingerprint(&self) -> u64 {
        self.fingerprint
    }

    fn is_on_contour(&self) -> bool {
        self.program.is_on_contour()
    }
}

fn refused(diagnostic: Diagnostic) -> Refusal {
    Refusal::Program {
        diagnostics: vec![diagnostic],
        unlisted: 0,
    }
}
