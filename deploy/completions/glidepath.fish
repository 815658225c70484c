# Print an optspec for argparse to handle cmd's options that are independent of any subcommand.
function __fish_glidepath_global_optspecs
    string join \n h/help V/version
end

function __fish_glidepath_needs_command
    # Figure out if the current invocation already has a command.
    set -l cmd (commandline -opc)
    set -e cmd[1]
    argparse -s (__fish_glidepath_global_optspecs) -- $cmd 2>/dev/null
    or return
    if set -q argv[1]
        # Also print the command, so this can be used to figure out what it is.
        echo $argv[1]
        return 1
    end
    return 0
end

function __fish_glidepath_using_subcommand
    set -l cmd (__fish_glidepath_needs_command)
    test -z "$cmd"
    and return 1
    contains -- $cmd[1] $argv
end

complete -c glidepath -n "__fish_glidepath_needs_command" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_needs_command" -s V -l version -d 'Print version'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "run" -d 'Plan a program, play it with a mock servo, and report'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "plan" -d 'Plan a program without waiting for the clock, and report'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "check" -d 'List all errors in programs, without motion'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "interpolator" -d 'The real-time process: turns frames into setpoints'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "planner" -d 'The planner process: reads a program, standard input, or segments of other processes, and plans frames'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "run-file" -d 'Run a program with the planner\'s service'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "mdi" -d 'Execute a line of G-code with the planner\'s service'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "servo" -d 'A servo: plays setpoints on a simulated machine, or on LinuxCNC\'s HAL'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "ethercat" -d 'The bridge to drives on EtherCAT: sends setpoints to them, and reports where the joints are'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "feed" -d 'Stream a program\'s segments to a listening planner, as another program would'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "status" -d 'Show the state of a running interpolator'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "live" -d 'Show the machine in a browser of this host, and operate it there with `--may operate`'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "grbl" -d 'Let senders of grbl (CNCjs, bCNC, gSender, UGS) drive the machine, by TCP or a pseudo-terminal'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "record" -d 'Record every setpoint and status in a file that other tools can open (MCAP), or be a black box'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "replay" -d 'Play a recording into a servo stack, in place of an interpolator'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "audit" -d 'Check a recording or a CSV file of setpoints: limits, order, gaps, and the path against its program'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "telemetry" -d 'Report to an MQTT broker what the machine does'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "mirror" -d 'Publish setpoints and status as ordinary services of iceoryx2, for programs that look on'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "hold" -d 'Feed hold: stop on the path; `resume` continues'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "resume" -d 'Continue after a hold, a program stop or the end of a block'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "step" -d 'Continue to the end of the block, and rest there'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "stop-at-block-end" -d 'Stop at the end of the present block, or of the first block where that is possible'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "reverse" -d 'Go back along the path: at most a minute, and not past what cannot be undone'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "forward" -d 'Go forward along the path again, after `reverse`'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "single-block" -d 'Turn single block on or off: rest at the end of every block; `resume` or `step` continues'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "override" -d 'Set the override of the feed, of rapids, of jogs or of the spindle'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "jog" -d 'Move axes by hand, by steps or by the keys of the terminal'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "return" -d 'Return to the path after a jog in a hold'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "acknowledge" -d 'Answer an M code that waits: it is done, or has failed'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "abort" -d 'Stop on the path and drop the rest of the program'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "reset" -d 'Clear a fault, whatever its cause; the machine is then idle'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "enable" -d 'Give the drives power, and take the position over from them'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "disable" -d 'Stop on the path, drop the rest of the program, and remove the power from the drives'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "home" -d 'Home joints, and wait until they are homed'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "unhome" -d 'Mark joints as not homed'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "set-position" -d 'Set the present position of a joint to a new value'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "preview" -d 'Find where a NURBS is too sharp for its feedrate'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "bench" -d 'Plan the benchmark programs, and compare them with bounds and another control'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "fit" -d 'Fit NURBS to the dense runs of short lines of a program'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "offsets" -d 'Show and change what the machine keeps over a restart: work offsets, G28, G30, G92, tools'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "setup" -d 'Describe a machine by answering questions, and have its configuration written'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "calibrate" -d 'Find the dimensions of a delta, a hexapod, an arm or a five-axis machine from measured points'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "config" -d 'Print, explain or check a configuration, or convert that of another control'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "doctor" -d 'Check whether this host is fit for real time, and give the fix for each shortcoming'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "jitter" -d 'Measure how late the real-time loop wakes on this host'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "help" -d 'Print this message or the help of the given subcommand(s)'
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l tool-table -d 'Tool table (LinuxCNC\'s .tbl); overrides `program.tool_table` of the configuration' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l subroutine-path -d 'Folder to search for subroutines in files of their own, after the folder of the program and before `program.subroutine_path` of the configuration; may be given several times' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l dialect -d 'Language of the program: linuxcnc, marlin, fanuc or siemens. Without it, the configuration or the beginning of the program decides' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l effort -d 'Effort of planning: optimal or fast; overrides `path.effort` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l tolerance -d 'How far the motion may leave the programmed path, mm; overrides `path.tolerance` of the configuration. G64 P of the program overrides both' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l instance -d 'Name of the run\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l drives -d 'What is moved: "mock", a servo that moves exactly as commanded, or "emulated", emulated drives on EtherCAT, with the same bridge as real ones' -r -f -a "mock\t'A mock servo'
emulated\t'Emulated drives on EtherCAT'"
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l bus-period-us -d 'Period of the bus of the emulated drives, µs' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l drives-record -d 'Write what the emulated drives recorded at every SYNC0 as CSV' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l setpoints -d 'Write the setpoints that the mock servo received as CSV' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l plot -d 'Write a plot of the motion: NAME.svg, or an interactive page, NAME.html. Without this option the plot goes to NAME.svg in the present folder, if no other file has that name' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l allow-unchecked -d 'Accept a program whose loops are too long to be checked to their end (20 million lines). The rest is checked only when the machine comes to it'
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l best-effort -d 'Run even without real-time privileges; the report says what was granted'
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l force -d 'Overwrite files even of another kind than the one written, but never a file that the command reads'
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c glidepath -n "__fish_glidepath_using_subcommand plan" -l tool-table -d 'Tool table (LinuxCNC\'s .tbl); overrides `program.tool_table` of the configuration' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand plan" -l subroutine-path -d 'Folder to search for subroutines in files of their own, after the folder of the program and before `program.subroutine_path` of the configuration; may be given several times' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand plan" -l dialect -d 'Language of the program: linuxcnc, marlin, fanuc or siemens. Without it, the configuration or the beginning of the program decides' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand plan" -l effort -d 'Effort of planning: optimal or fast; overrides `path.effort` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand plan" -l tolerance -d 'How far the motion may leave the programmed path, mm; overrides `path.tolerance` of the configuration. G64 P of the program overrides both' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand plan" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand plan" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand plan" -l setpoints -d 'Write every setpoint as CSV' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand plan" -l plot -d 'Write a plot of the motion: NAME.svg, or an interactive page, NAME.html' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand plan" -l longest -d 'Refuse programs whose feeds and dwells take longer than this, such as 90s, 10min, 8h or 30d' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand plan" -l allow-unchecked -d 'Accept a program whose loops are too long to be checked to their end (20 million lines). The rest is checked only when the machine comes to it'
complete -c glidepath -n "__fish_glidepath_using_subcommand plan" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand plan" -l force -d 'Overwrite files even of another kind than the one written, but never a file that the command reads'
complete -c glidepath -n "__fish_glidepath_using_subcommand plan" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand check" -l tool-table -d 'Tool table (LinuxCNC\'s .tbl); overrides `program.tool_table` of the configuration' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand check" -l subroutine-path -d 'Folder to search for subroutines in files of their own, after the folder of the program and before `program.subroutine_path` of the configuration; may be given several times' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand check" -l dialect -d 'Language of the program: linuxcnc, marlin, fanuc or siemens. Without it, the configuration or the beginning of the program decides' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand check" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand check" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand check" -l allow-unchecked -d 'Accept a program whose loops are too long to be checked to their end (20 million lines). The rest is checked only when the machine comes to it'
complete -c glidepath -n "__fish_glidepath_using_subcommand check" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand check" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand interpolator" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand interpolator" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand interpolator" -l end-with -d 'End when the process with this number, which started this one, ends' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand interpolator" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand interpolator" -l best-effort -d 'Run even without real-time privileges'
complete -c glidepath -n "__fish_glidepath_using_subcommand interpolator" -l expect-drives -d 'Expect drives to answer, whatever the configuration says'
complete -c glidepath -n "__fish_glidepath_using_subcommand interpolator" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand planner" -l tool-table -d 'Tool table (LinuxCNC\'s .tbl); overrides `program.tool_table` of the configuration' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand planner" -l subroutine-path -d 'Folder to search for subroutines in files of their own, after the folder of the program and before `program.subroutine_path` of the configuration; may be given several times' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand planner" -l dialect -d 'Language of the program: linuxcnc, marlin, fanuc or siemens. Without it, the configuration or the beginning of the program decides' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand planner" -l effort -d 'Effort of planning: optimal or fast; overrides `path.effort` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand planner" -l tolerance -d 'How far the motion may leave the programmed path, mm; overrides `path.tolerance` of the configuration. G64 P of the program overrides both' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand planner" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand planner" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand planner" -l end-with -d 'End when the process with this number, which started this one, ends' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand planner" -l listen -d 'Run as the service of the machine: execute lines (`mdi`), programs (`run-file`) and segments of other processes (`feed`), one at a time'
complete -c glidepath -n "__fish_glidepath_using_subcommand planner" -l resume -d 'Continue the program from where the machine stands on its path'
complete -c glidepath -n "__fish_glidepath_using_subcommand planner" -l allow-unchecked -d 'Accept a program whose loops are too long to be checked to their end (20 million lines). The rest is checked only when the machine comes to it'
complete -c glidepath -n "__fish_glidepath_using_subcommand planner" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand planner" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c glidepath -n "__fish_glidepath_using_subcommand run-file" -l from-line -d 'Start at this line, as if all lines before it had been executed' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand run-file" -l pass -d 'Start at this pass, if the line is executed several times' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand run-file" -l tolerance-ratio -d 'Plan with so many times the tolerance of the configuration and of G64 P, .1 to 10' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand run-file" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand run-file" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand run-file" -l yes -d 'Answer yes to the question'
complete -c glidepath -n "__fish_glidepath_using_subcommand run-file" -l resume -d 'Continue this program where it was left, after an abort or a fault'
complete -c glidepath -n "__fish_glidepath_using_subcommand run-file" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand run-file" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c glidepath -n "__fish_glidepath_using_subcommand mdi" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand mdi" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand mdi" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand mdi" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l setpoints -d 'Write the setpoints received as CSV' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l stands -d 'Where the joints of the simulated machine are at the start, mm or degrees, such as 12.5,-3,40. Without it, they are where programs begin' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l probe -d 'Simulate a probe that makes contact when a joint is at a position or below, such as J2=-10. The contact is input 0' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l hal-period-us -d 'Period of HAL\'s thread, µs' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l hal-prefill -d 'How many periods HAL lags behind the setpoints, and this process may be late' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l hal-wait-us -d 'How late setpoints may arrive, µs; HAL plays them later by that time. Without it, a period of the setpoints' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l hal-channel -d 'The number of `streamer` and `sampler`' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l end-with -d 'End when the process with this number, which started this one, ends' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l best-effort -d 'Let setpoints stay away for eight periods in place of three before the joints stop by themselves: for hosts without real time'
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l hal -d 'Play on LinuxCNC\'s HAL: send lines to `streamer`, take feedback from `sampler`'
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l force -d 'Overwrite files even of another kind than the one written, but never a file that the command reads'
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l listens -d 'Move nothing and send no feedback: another stack has the drives'
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l relay -d 'Write every record received to standard output, for the process that started this one'
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -l drives -d 'File with the devices on the bus, and the joint that each drive moves' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -l cpu -d 'CPU to which the thread of the bus is pinned' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -l priority -d 'SCHED_FIFO priority of the thread of the bus, 1 to 99' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -l emulated-period-us -d 'Period of the bus of the emulated drives, µs' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -l emulated-record -d 'Write what the emulated drives recorded at every SYNC0 as CSV' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -l emulated-inputs -d 'What stands at the inputs of the emulated devices: a file with lines like `input 3 on`, `home 0 on`, `limit_low 1 off`, `limit_high 1 off`, `analog 0 2.5` and `input 0 at J2 -7.25` (on where J2 is there or beyond), looked at while they run. Without --drives there is a device that has inputs of every kind' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -l end-with -d 'End when the process with this number, which started this one, ends' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -l best-effort -d 'Run even without real-time privileges'
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -l emulated -d 'Use emulated drives, over a pair of virtual interfaces in a network namespace of their own. Without --drives there are three drives, or as many as the machine has joints'
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -l in-namespace -d 'It is in its namespace already'
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -f -a "scan" -d 'List the devices on the bus, as a first drives.toml; nothing moves'
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -f -a "help" -d 'Print this message or the help of the given subcommand(s)'
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and __fish_seen_subcommand_from scan" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and __fish_seen_subcommand_from scan" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and __fish_seen_subcommand_from help" -f -a "scan" -d 'List the devices on the bus, as a first drives.toml; nothing moves'
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and __fish_seen_subcommand_from help" -f -a "help" -d 'Print this message or the help of the given subcommand(s)'
complete -c glidepath -n "__fish_glidepath_using_subcommand feed" -l tool-table -d 'Tool table (LinuxCNC\'s .tbl); overrides `program.tool_table` of the configuration' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand feed" -l subroutine-path -d 'Folder to search for subroutines in files of their own, after the folder of the program and before `program.subroutine_path` of the configuration; may be given several times' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand feed" -l dialect -d 'Language of the program: linuxcnc, marlin, fanuc or siemens. Without it, the configuration or the beginning of the program decides' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand feed" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand feed" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand feed" -l allow-unchecked -d 'Accept a program whose loops are too long to be checked to their end (20 million lines). The rest is checked only when the machine comes to it'
complete -c glidepath -n "__fish_glidepath_using_subcommand feed" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand feed" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand status" -l every -d 'Time between two displays, s' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand status" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand status" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand status" -l watch -d 'Repeat until Ctrl-C; with --json, print one object per line'
complete -c glidepath -n "__fish_glidepath_using_subcommand status" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand status" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand live; and not __fish_seen_subcommand_from devices help" -l port -d 'The port on 127.0.0.1; 0 selects any free one' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand live; and not __fish_seen_subcommand_from devices help" -l may -d 'What the page may do: only look; hold and abort; or operate the machine' -r -f -a "look\t'See the machine'
hold\t'See it and stop it: hold and abort'
operate\t'Do all that an operator does'"
complete -c glidepath -n "__fish_glidepath_using_subcommand live; and not __fish_seen_subcommand_from devices help" -l devices -d 'An address of this host, with a port, where paired tablets and phones open the page over TLS, to look and to hold; without it there is none' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand live; and not __fish_seen_subcommand_from devices help" -l shortcut -d 'A file that is written to open the page in a browser, and that says so where the page has ended. Whoever can read it may do what the page may: this user, and in a folder with the setgid bit its group' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand live; and not __fish_seen_subcommand_from devices help" -l programs -d 'Folder of the programs that the page lists, runs and stores' -r -f -a "(__fish_complete_directories)"
complete -c glidepath -n "__fish_glidepath_using_subcommand live; and not __fish_seen_subcommand_from devices help" -l tool-table -d 'Tool table (LinuxCNC\'s .tbl); overrides `program.tool_table` of the configuration' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand live; and not __fish_seen_subcommand_from devices help" -l subroutine-path -d 'Folder to search for subroutines in files of their own, after the folder of the program and before `program.subroutine_path` of the configuration; may be given several times' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand live; and not __fish_seen_subcommand_from devices help" -l dialect -d 'Language of the program: linuxcnc, marlin, fanuc or siemens. Without it, the configuration or the beginning of the program decides' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand live; and not __fish_seen_subcommand_from devices help" -l effort -d 'Effort of planning: optimal or fast; overrides `path.effort` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand live; and not __fish_seen_subcommand_from devices help" -l tolerance -d 'How far the motion may leave the programmed path, mm; overrides `path.tolerance` of the configuration. G64 P of the program overrides both' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand live; and not __fish_seen_subcommand_from devices help" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand live; and not __fish_seen_subcommand_from devices help" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand live; and not __fish_seen_subcommand_from devices help" -l listed -d 'List this machine on the pages of the other machines of this user on this host, with a way to this page: to what each of them may itself'
complete -c glidepath -n "__fish_glidepath_using_subcommand live; and not __fish_seen_subcommand_from devices help" -l allow-unchecked -d 'Accept a program whose loops are too long to be checked to their end (20 million lines). The rest is checked only when the machine comes to it'
complete -c glidepath -n "__fish_glidepath_using_subcommand live; and not __fish_seen_subcommand_from devices help" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand live; and not __fish_seen_subcommand_from devices help" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c glidepath -n "__fish_glidepath_using_subcommand live; and not __fish_seen_subcommand_from devices help" -a "devices" -d 'List the paired tablets and phones, or revoke one; the page need not run'
complete -c glidepath -n "__fish_glidepath_using_subcommand live; and not __fish_seen_subcommand_from devices help" -a "help" -d 'Print this message or the help of the given subcommand(s)'
complete -c glidepath -n "__fish_glidepath_using_subcommand live; and __fish_seen_subcommand_from devices" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand live; and __fish_seen_subcommand_from devices" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand live; and __fish_seen_subcommand_from devices" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand live; and __fish_seen_subcommand_from devices" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand live; and __fish_seen_subcommand_from devices" -f -a "revoke" -d 'End the pairing of a device: what it has open ends within a second or two'
complete -c glidepath -n "__fish_glidepath_using_subcommand live; and __fish_seen_subcommand_from devices" -f -a "help" -d 'Print this message or the help of the given subcommand(s)'
complete -c glidepath -n "__fish_glidepath_using_subcommand live; and __fish_seen_subcommand_from help" -f -a "devices" -d 'List the paired tablets and phones, or revoke one; the page need not run'
complete -c glidepath -n "__fish_glidepath_using_subcommand live; and __fish_seen_subcommand_from help" -f -a "help" -d 'Print this message or the help of the given subcommand(s)'
complete -c glidepath -n "__fish_glidepath_using_subcommand grbl" -l port -d 'The TCP port on 127.0.0.1; 0 selects any free one. Without --port and --pty it is 2323' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand grbl" -l pty -d 'Create this link to a pseudo-terminal, for senders that open serial ports' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand grbl" -l user -d 'Another user, by number, whose programs may connect by TCP, in addition to this one\'s and root\'s' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand grbl" -l ahead -d 'Seconds of planned motion before ok is withheld' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand grbl" -l rx-bytes -d 'Bytes that a sender may have unanswered' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand grbl" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand grbl" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand grbl" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand grbl" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand record" -l program -d 'The running program, to be part of the recording, so that `audit` can check against it' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand record" -l ring -d 'Be a black box: keep the last minutes (such as 10min or 90s) in memory, and write them to FILE, with the time in its name, when a fault stops the machine' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand record" -l seconds -d 'End after this many seconds; without it, record until Ctrl-C' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand record" -l effort -d 'Effort of planning: optimal or fast; overrides `path.effort` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand record" -l tolerance -d 'How far the motion may leave the programmed path, mm; overrides `path.tolerance` of the configuration. G64 P of the program overrides both' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand record" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand record" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand record" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand record" -l force -d 'Overwrite files even of another kind than the one written, but never a file that the command reads'
complete -c glidepath -n "__fish_glidepath_using_subcommand record" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand replay" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand replay" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand replay" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand replay" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand audit" -l program -d 'The program that the motion has to follow; a recording may contain its own' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand audit" -l tool-table -d 'Tool table (LinuxCNC\'s .tbl); overrides `program.tool_table` of the configuration' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand audit" -l subroutine-path -d 'Folder to search for subroutines in files of their own, after the folder of the program and before `program.subroutine_path` of the configuration; may be given several times' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand audit" -l dialect -d 'Language of the program: linuxcnc, marlin, fanuc or siemens. Without it, the configuration or the beginning of the program decides' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand audit" -l effort -d 'Effort of planning: optimal or fast; overrides `path.effort` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand audit" -l tolerance -d 'How far the motion may leave the programmed path, mm; overrides `path.tolerance` of the configuration. G64 P of the program overrides both' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand audit" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand audit" -l allow-unchecked -d 'Accept a program whose loops are too long to be checked to their end (20 million lines). The rest is checked only when the machine comes to it'
complete -c glidepath -n "__fish_glidepath_using_subcommand audit" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand audit" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand telemetry" -l broker -d 'The broker, as HOST or HOST:PORT' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand telemetry" -l topic -d 'First part of all topics: TOPIC/INSTANCE/status and so on' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand telemetry" -l user -d 'User at the broker; the password comes from the environment variable GLIDEPATH_MQTT_PASSWORD' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand telemetry" -l rate -d 'Messages per second while the machine moves' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand telemetry" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand telemetry" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand telemetry" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand telemetry" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand mirror" -l root -d 'Root of iceoryx2\'s domain, where readers find the services; without it that of iceoryx2\'s configuration on this host (/tmp/iceoryx2)' -r -f -a "(__fish_complete_directories)"
complete -c glidepath -n "__fish_glidepath_using_subcommand mirror" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand mirror" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand mirror" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand mirror" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand hold" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand hold" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand hold" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand hold" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand resume" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand resume" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand resume" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand resume" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand step" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand step" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand step" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand step" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand stop-at-block-end" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand stop-at-block-end" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand stop-at-block-end" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand stop-at-block-end" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand reverse" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand reverse" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand reverse" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand reverse" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand forward" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand forward" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand forward" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand forward" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand single-block" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand single-block" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand single-block" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand single-block" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c glidepath -n "__fish_glidepath_using_subcommand override" -l rapid -d 'Percent of the speed of rapids, 0 to 100' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand override" -l jog -d 'Percent of the speed of jogs, 0 to 100' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand override" -l spindle -d 'Percent of the programmed speed of the spindle, within `override_min` and `override_max` of `[spindle]`' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand override" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand override" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand override" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand override" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand jog" -l feed -d 'Speed along the move, in mm/min or °/min; limited by the jog speed of each axis' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand jog" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand jog" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand jog" -l by-joint -d 'The letters mean the joints of these axes; only on a machine whose joints are its axes'
complete -c glidepath -n "__fish_glidepath_using_subcommand jog" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand jog" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand return" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand return" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand return" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand return" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand acknowledge" -l fail -d 'Report that the M code has failed, with the reason as a text' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand acknowledge" -l event -d 'Answer only this event: EPOCH/SEQUENCE, from `awaited` of `status --json`' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand acknowledge" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand acknowledge" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand acknowledge" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand acknowledge" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand abort" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand abort" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand abort" -l signal -d 'The last resort: end the interpolator by SIGTERM, which needs no shared memory'
complete -c glidepath -n "__fish_glidepath_using_subcommand abort" -l no-lift -d 'Do not raise the tool axis by `jog.lift` of the configuration'
complete -c glidepath -n "__fish_glidepath_using_subcommand abort" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand abort" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand reset" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand reset" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand reset" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand reset" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand enable" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand enable" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand enable" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand enable" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand disable" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand disable" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand disable" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand disable" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand home" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand home" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand home" -l no-wait -d 'Return at once, without waiting until the joints are homed'
complete -c glidepath -n "__fish_glidepath_using_subcommand home" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand home" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand unhome" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand unhome" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand unhome" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand unhome" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand set-position" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand set-position" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand set-position" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand set-position" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand preview" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand preview" -l method -d 'How to read the curve' -r -f -a "traditional\t'Tick by tick'
advance-retreat\t'By growing steps that go back where they find something'
certified\t'By bounds and roots of polynomials; misses nothing'"
complete -c glidepath -n "__fish_glidepath_using_subcommand preview" -l period-us -d 'Period of a setpoint, µs' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand preview" -l feed -d 'Feedrate, mm/min' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand preview" -l chord-error -d 'Chord error of one period, mm; without it, the path tolerance' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand preview" -l plot -d 'Write a plot of the curve, coloured by the speed it allows (SVG)' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand preview" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand preview" -l force -d 'Overwrite files even of another kind than the one written, but never a file that the command reads'
complete -c glidepath -n "__fish_glidepath_using_subcommand preview" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c glidepath -n "__fish_glidepath_using_subcommand bench" -l config-dir -d 'Folder with the configuration of each machine that the catalogue names, such as mill.toml; without it, the built-in ones' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand bench" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand bench" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand bench" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand fit" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand fit" -l tolerance -d 'Largest distance between curve and lines, in both directions, mm' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand fit" -l method -d 'How to find the curve' -r -f -a "least-squares\t'Knots step by step, control points by least squares'
foraging\t'Control points by bacterial foraging, as published'
hybrid\t'Knots by bacterial foraging, control points by least squares'"
complete -c glidepath -n "__fish_glidepath_using_subcommand fit" -l seed -d 'Seed of the search; the same seed gives the same curve' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand fit" -l output -d 'Write the result: a curve file (.toml, of one run) or a program (.ngc)' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand fit" -l plot -d 'Write a plot of the curves with their control points (SVG)' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand fit" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand fit" -l force -d 'Overwrite files even of another kind than the one written, but never a file that the command reads'
complete -c glidepath -n "__fish_glidepath_using_subcommand fit" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and not __fish_seen_subcommand_from show set use import export adopt recover help" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and not __fish_seen_subcommand_from show set use import export adopt recover help" -f -a "show" -d 'Show everything that is kept'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and not __fish_seen_subcommand_from show set use import export adopt recover help" -f -a "set" -d 'Set a coordinate system, the position of G28 or G30, or the kept offset of G92'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and not __fish_seen_subcommand_from show set use import export adopt recover help" -f -a "use" -d 'Choose the coordinate system in which programs start'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and not __fish_seen_subcommand_from show set use import export adopt recover help" -f -a "import" -d 'Import coordinates from LinuxCNC\'s parameter file (.var)'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and not __fish_seen_subcommand_from show set use import export adopt recover help" -f -a "export" -d 'Print coordinates in the format of LinuxCNC\'s parameter file'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and not __fish_seen_subcommand_from show set use import export adopt recover help" -f -a "adopt" -d 'Use the kept state of a machine with other axes or kinematics for this machine'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and not __fish_seen_subcommand_from show set use import export adopt recover help" -f -a "recover" -d 'After a file was damaged: use the newest intact generation'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and not __fish_seen_subcommand_from show set use import export adopt recover help" -f -a "help" -d 'Print this message or the help of the given subcommand(s)'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from show" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from show" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from show" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from show" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from set" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from set" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from set" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from set" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from use" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from use" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from use" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from use" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from import" -l linear-units -d '`LINEAR_UNITS` of `[TRAJ]` in LinuxCNC\'s machine configuration' -r -f -a "mm\t'Millimetres'
inch\t'Inches'"
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from import" -l angular-units -d '`ANGULAR_UNITS` of `[TRAJ]`' -r -f -a "degree\t'Degrees'
radian\t'Radians'
grad\t'Gradians: 400 in a turn'"
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from import" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from import" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from import" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from import" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from export" -l linear-units -d '`LINEAR_UNITS` of `[TRAJ]` in LinuxCNC\'s machine configuration' -r -f -a "mm\t'Millimetres'
inch\t'Inches'"
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from export" -l angular-units -d '`ANGULAR_UNITS` of `[TRAJ]`' -r -f -a "degree\t'Degrees'
radian\t'Radians'
grad\t'Gradians: 400 in a turn'"
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from export" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from export" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from export" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from export" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from adopt" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from adopt" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from adopt" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from adopt" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from recover" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from recover" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from recover" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from recover" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from help" -f -a "show" -d 'Show everything that is kept'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from help" -f -a "set" -d 'Set a coordinate system, the position of G28 or G30, or the kept offset of G92'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from help" -f -a "use" -d 'Choose the coordinate system in which programs start'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from help" -f -a "import" -d 'Import coordinates from LinuxCNC\'s parameter file (.var)'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from help" -f -a "export" -d 'Print coordinates in the format of LinuxCNC\'s parameter file'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from help" -f -a "adopt" -d 'Use the kept state of a machine with other axes or kinematics for this machine'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from help" -f -a "recover" -d 'After a file was damaged: use the newest intact generation'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from help" -f -a "help" -d 'Print this message or the help of the given subcommand(s)'
complete -c glidepath -n "__fish_glidepath_using_subcommand setup" -l suggested -d 'Take the suggested answer to every question'
complete -c glidepath -n "__fish_glidepath_using_subcommand setup" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand calibrate" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand calibrate" -l accuracy -d 'How accurately X, Y and Z were measured: standard deviation, mm' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand calibrate" -l angle-accuracy -d 'How accurately A, B and C were measured: standard deviation, °' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand calibrate" -l within -d 'A dimension with a larger standard deviation counts as not told, and keeps its value, mm or °' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand calibrate" -l keep -d 'A dimension that keeps its value, such as `rod`, `tower_angles` or `J2` (its zero); may be given several times' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand calibrate" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand calibrate" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and not __fish_seen_subcommand_from from-linuxcnc from-grbl from-klipper from-screw help" -l explain -d 'Explain a key, all keys of a table, or every key: meaning, unit, range, default' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and not __fish_seen_subcommand_from from-linuxcnc from-grbl from-klipper from-screw help" -l check -d 'List all errors in a configuration, and in the files and folders that it names' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and not __fish_seen_subcommand_from from-linuxcnc from-grbl from-klipper from-screw help" -l default -d 'Print the built-in machine as a configuration, with every key explained'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and not __fish_seen_subcommand_from from-linuxcnc from-grbl from-klipper from-screw help" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and not __fish_seen_subcommand_from from-linuxcnc from-grbl from-klipper from-screw help" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and not __fish_seen_subcommand_from from-linuxcnc from-grbl from-klipper from-screw help" -f -a "from-linuxcnc" -d 'Convert LinuxCNC\'s machine configuration'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and not __fish_seen_subcommand_from from-linuxcnc from-grbl from-klipper from-screw help" -f -a "from-grbl" -d 'Convert grbl\'s or grblHAL\'s settings, as `$$` and `$#` print them'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and not __fish_seen_subcommand_from from-linuxcnc from-grbl from-klipper from-screw help" -f -a "from-klipper" -d 'Convert Klipper\'s printer.cfg'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and not __fish_seen_subcommand_from from-linuxcnc from-grbl from-klipper from-screw help" -f -a "from-screw" -d 'Make the compensation of a joint from a measured screw: LinuxCNC\'s COMP_FILE, or columns of a laser or gauge'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and not __fish_seen_subcommand_from from-linuxcnc from-grbl from-klipper from-screw help" -f -a "help" -d 'Print this message or the help of the given subcommand(s)'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and __fish_seen_subcommand_from from-linuxcnc" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and __fish_seen_subcommand_from from-linuxcnc" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and __fish_seen_subcommand_from from-grbl" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and __fish_seen_subcommand_from from-grbl" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and __fish_seen_subcommand_from from-klipper" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and __fish_seen_subcommand_from from-klipper" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and __fish_seen_subcommand_from from-screw" -l joint -d 'The joint, J0 to J8' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and __fish_seen_subcommand_from from-screw" -l values -d 'What the values are' -r -f -a "measured\t'Where the carriage was (LinuxCNC\'s COMP_FILE_TYPE = 0)'
errors\t'How far beyond its position it was'
trims\t'What is to be added to the position (LinuxCNC\'s COMP_FILE_TYPE = 1)'"
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and __fish_seen_subcommand_from from-screw" -l unit -d 'Unit of the file; degrees are mm' -r -f -a "mm\t'Millimetres, or degrees'
inch\t'Inches'"
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and __fish_seen_subcommand_from from-screw" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and __fish_seen_subcommand_from from-screw" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and __fish_seen_subcommand_from help" -f -a "from-linuxcnc" -d 'Convert LinuxCNC\'s machine configuration'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and __fish_seen_subcommand_from help" -f -a "from-grbl" -d 'Convert grbl\'s or grblHAL\'s settings, as `$$` and `$#` print them'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and __fish_seen_subcommand_from help" -f -a "from-klipper" -d 'Convert Klipper\'s printer.cfg'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and __fish_seen_subcommand_from help" -f -a "from-screw" -d 'Make the compensation of a joint from a measured screw: LinuxCNC\'s COMP_FILE, or columns of a laser or gauge'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and __fish_seen_subcommand_from help" -f -a "help" -d 'Print this message or the help of the given subcommand(s)'
complete -c glidepath -n "__fish_glidepath_using_subcommand doctor" -l interface -d 'Also check this network interface of drives' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand doctor" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand doctor" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand doctor" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand jitter" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand jitter" -l period-us -d 'Period of the loop, µs' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand jitter" -l seconds -d 'How long to measure, s' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand jitter" -l cpu -d 'CPU to which the loop is pinned' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand jitter" -l priority -d 'SCHED_FIFO priority, 1 to 99' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand jitter" -l plot -d 'Write a plot of the latency (SVG)' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand jitter" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand jitter" -l best-effort -d 'Measure even without real-time privileges'
complete -c glidepath -n "__fish_glidepath_using_subcommand jitter" -l full-tick -d 'Do the interpolator\'s work in every period, on a synthetic motion'
complete -c glidepath -n "__fish_glidepath_using_subcommand jitter" -l against-cyclictest -d 'Run cyclictest at the same time on the same CPU, half a period apart, and compare'
complete -c glidepath -n "__fish_glidepath_using_subcommand jitter" -l force -d 'Overwrite files even of another kind than the one written, but never a file that the command reads'
complete -c glidepath -n "__fish_glidepath_using_subcommand jitter" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "run" -d 'Plan a program, play it with a mock servo, and report'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "plan" -d 'Plan a program without waiting for the clock, and report'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "check" -d 'List all errors in programs, without motion'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "interpolator" -d 'The real-time process: turns frames into setpoints'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "planner" -d 'The planner process: reads a program, standard input, or segments of other processes, and plans frames'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "run-file" -d 'Run a program with the planner\'s service'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "mdi" -d 'Execute a line of G-code with the planner\'s service'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "servo" -d 'A servo: plays setpoints on a simulated machine, or on LinuxCNC\'s HAL'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "ethercat" -d 'The bridge to drives on EtherCAT: sends setpoints to them, and reports where the joints are'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "feed" -d 'Stream a program\'s segments to a listening planner, as another program would'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "status" -d 'Show the state of a running interpolator'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "live" -d 'Show the machine in a browser of this host, and operate it there with `--may operate`'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "grbl" -d 'Let senders of grbl (CNCjs, bCNC, gSender, UGS) drive the machine, by TCP or a pseudo-terminal'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "record" -d 'Record every setpoint and status in a file that other tools can open (MCAP), or be a black box'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "replay" -d 'Play a recording into a servo stack, in place of an interpolator'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "audit" -d 'Check a recording or a CSV file of setpoints: limits, order, gaps, and the path against its program'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "telemetry" -d 'Report to an MQTT broker what the machine does'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "mirror" -d 'Publish setpoints and status as ordinary services of iceoryx2, for programs that look on'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "hold" -d 'Feed hold: stop on the path; `resume` continues'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "resume" -d 'Continue after a hold, a program stop or the end of a block'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "step" -d 'Continue to the end of the block, and rest there'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "stop-at-block-end" -d 'Stop at the end of the present block, or of the first block where that is possible'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "reverse" -d 'Go back along the path: at most a minute, and not past what cannot be undone'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "forward" -d 'Go forward along the path again, after `reverse`'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "single-block" -d 'Turn single block on or off: rest at the end of every block; `resume` or `step` continues'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "override" -d 'Set the override of the feed, of rapids, of jogs or of the spindle'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "jog" -d 'Move axes by hand, by steps or by the keys of the terminal'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "return" -d 'Return to the path after a jog in a hold'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "acknowledge" -d 'Answer an M code that waits: it is done, or has failed'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "abort" -d 'Stop on the path and drop the rest of the program'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "reset" -d 'Clear a fault, whatever its cause; the machine is then idle'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "enable" -d 'Give the drives power, and take the position over from them'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "disable" -d 'Stop on the path, drop the rest of the program, and remove the power from the drives'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "home" -d 'Home joints, and wait until they are homed'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "unhome" -d 'Mark joints as not homed'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "set-position" -d 'Set the present position of a joint to a new value'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "preview" -d 'Find where a NURBS is too sharp for its feedrate'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "bench" -d 'Plan the benchmark programs, and compare them with bounds and another control'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "fit" -d 'Fit NURBS to the dense runs of short lines of a program'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "offsets" -d 'Show and change what the machine keeps over a restart: work offsets, G28, G30, G92, tools'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "setup" -d 'Describe a machine by answering questions, and have its configuration written'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "calibrate" -d 'Find the dimensions of a delta, a hexapod, an arm or a five-axis machine from measured points'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "config" -d 'Print, explain or check a configuration, or convert that of another control'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "doctor" -d 'Check whether this host is fit for real time, and give the fix for each shortcoming'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "jitter" -d 'Measure how late the real-time loop wakes on this host'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry mirror hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets setup calibrate config doctor jitter help" -f -a "help" -d 'Print this message or the help of the given subcommand(s)'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and __fish_seen_subcommand_from ethercat" -f -a "scan" -d 'List the devices on the bus, as a first drives.toml; nothing moves'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and __fish_seen_subcommand_from live" -f -a "devices" -d 'List the paired tablets and phones, or revoke one; the page need not run'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and __fish_seen_subcommand_from offsets" -f -a "show" -d 'Show everything that is kept'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and __fish_seen_subcommand_from offsets" -f -a "set" -d 'Set a coordinate system, the position of G28 or G30, or the kept offset of G92'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and __fish_seen_subcommand_from offsets" -f -a "use" -d 'Choose the coordinate system in which programs start'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and __fish_seen_subcommand_from offsets" -f -a "import" -d 'Import coordinates from LinuxCNC\'s parameter file (.var)'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and __fish_seen_subcommand_from offsets" -f -a "export" -d 'Print coordinates in the format of LinuxCNC\'s parameter file'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and __fish_seen_subcommand_from offsets" -f -a "adopt" -d 'Use the kept state of a machine with other axes or kinematics for this machine'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and __fish_seen_subcommand_from offsets" -f -a "recover" -d 'After a file was damaged: use the newest intact generation'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and __fish_seen_subcommand_from config" -f -a "from-linuxcnc" -d 'Convert LinuxCNC\'s machine configuration'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and __fish_seen_subcommand_from config" -f -a "from-grbl" -d 'Convert grbl\'s or grblHAL\'s settings, as `$$` and `$#` print them'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and __fish_seen_subcommand_from config" -f -a "from-klipper" -d 'Convert Klipper\'s printer.cfg'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and __fish_seen_subcommand_from config" -f -a "from-screw" -d 'Make the compensation of a joint from a measured screw: LinuxCNC\'s COMP_FILE, or columns of a laser or gauge'
