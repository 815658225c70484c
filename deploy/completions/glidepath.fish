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
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "plan" -d 'Compute the same motion without waiting for the clock'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "check" -d 'List everything wrong with programs; no motion'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "interpolator" -d 'The real-time process: frames in, setpoints out'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "planner" -d 'The planner process: a program, standard input, or segments of other processes to frames'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "run-file" -d 'Have the planner\'s service execute a program'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "mdi" -d 'Have the planner\'s service execute a line'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "servo" -d 'A servo: plays setpoints on a machine that is not there, or on LinuxCNC\'s HAL'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "ethercat" -d 'Drives on EtherCAT: setpoints to targets, and where the joints are back'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "feed" -d 'Stream a program\'s segments to a listening planner, as another program would'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "status" -d 'Show the state of a running interpolator'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "live" -d 'Show the machine in a browser of this host, and operate it there if that is allowed'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "grbl" -d 'Let senders of grbl (CNCjs, bCNC, gSender, UGS) drive the machine, by TCP or a pseudo-terminal'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "record" -d 'Record every setpoint and status in a file that others can open (MCAP), or be a black box'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "replay" -d 'Play a recording into a servo stack, in place of an interpolator'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "audit" -d 'Judge a recording or a CSV file of setpoints: limits, order, gaps, and the path by its program'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "telemetry" -d 'Tell an MQTT broker what the machine does'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "hold" -d 'Feed hold: come to rest on the path'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "resume" -d 'Go on after a hold, a program stop or the end of a block'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "step" -d 'Go on to the end of the block, and rest there'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "stop-at-block-end" -d 'Come to rest at the end of the present block, or of the first at which that is possible'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "reverse" -d 'Go back along the path that was run: at most a minute, and not past what cannot be undone'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "forward" -d 'Go onward along the path, after `reverse`'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "single-block" -d 'Rest at the end of every block, or do so no longer; `resume` or `step` goes on'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "override" -d 'Set the override of the feed, of rapids, or of jogs'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "jog" -d 'Move axes by hand: by steps, or by the keys of the terminal'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "return" -d 'Go back to the path, after a jog in a hold'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "acknowledge" -d 'Say that what an M code asked for is done, or has failed: the motion waits for it'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "abort" -d 'Come to rest on the path and drop the rest of the program'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "reset" -d 'Take note of a fault, whatever its cause: the machine is idle again'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "enable" -d 'Give the drives power, and take the position over from them'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "disable" -d 'Come to rest on the path, drop the rest of the program, and take the power from the drives'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "home" -d 'Have drives find the home of their joints, and wait for that'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "unhome" -d 'Make joints count as not homed'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "set-position" -d 'Give the present position of a joint another number'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "preview" -d 'Find where a NURBS is too sharp for its feedrate'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "bench" -d 'Plan the benchmark programs, and compare with what is known of them'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "fit" -d 'Fit NURBS to the dense runs of short lines of a program'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "offsets" -d 'What the machine keeps over a restart: work offsets, G28, G30, G92, tools'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "config" -d 'The configuration: print one, explain its keys, check one, convert one of another control'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "doctor" -d 'Is this host fit for real time? With the fix for each no'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "jitter" -d 'Measure how late the real-time loop wakes on this host'
complete -c glidepath -n "__fish_glidepath_needs_command" -f -a "help" -d 'Print this message or the help of the given subcommand(s)'
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l tool-table -d 'Tool table (LinuxCNC\'s .tbl); overrides `program.tool_table` of the configuration' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l subroutine-path -d 'Folder to look in for subroutines in files of their own, behind that of the program; may be given several times, and comes before `program.subroutine_path` of the configuration' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l dialect -d 'Language of the program: linuxcnc, marlin, fanuc or siemens; else told by its beginning' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l effort -d 'optimal or fast; overrides `path.effort` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l tolerance -d 'How far the motion may leave the programmed path, mm; overrides `path.tolerance` of the configuration, as G64 P of the program overrides both' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l instance -d 'Name of the run\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l drives -d 'What is moved: "mock", a servo that does exactly what it is told, or "emulated", drives on an EtherCAT that is not there, with the bridge that real ones are driven by' -r -f -a "mock\t'A mock servo'
emulated\t'Emulated drives on EtherCAT'"
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l bus-period-us -d 'Period of the bus to emulated drives, µs' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l drives-record -d 'Write what the emulated drives recorded at every SYNC0 as CSV' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l setpoints -d 'Write the setpoints the mock servo received as CSV' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l plot -d 'Write a plot of the motion: NAME.svg, or a page to look closer, NAME.html; without it the plot goes to NAME.svg in the present folder, if no other file has that name' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l allow-unchecked -d 'Take a program whose loops go on for too long to be checked to their end (20 million lines): what it does behind that is judged only when it comes to it'
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l best-effort -d 'Run without real-time privileges too; the report says what was granted'
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -l force -d 'Overwrite files that are not of the kind that is written; never one that is read'
complete -c glidepath -n "__fish_glidepath_using_subcommand run" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c glidepath -n "__fish_glidepath_using_subcommand plan" -l tool-table -d 'Tool table (LinuxCNC\'s .tbl); overrides `program.tool_table` of the configuration' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand plan" -l subroutine-path -d 'Folder to look in for subroutines in files of their own, behind that of the program; may be given several times, and comes before `program.subroutine_path` of the configuration' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand plan" -l dialect -d 'Language of the program: linuxcnc, marlin, fanuc or siemens; else told by its beginning' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand plan" -l effort -d 'optimal or fast; overrides `path.effort` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand plan" -l tolerance -d 'How far the motion may leave the programmed path, mm; overrides `path.tolerance` of the configuration, as G64 P of the program overrides both' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand plan" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand plan" -l setpoints -d 'Write every setpoint as CSV' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand plan" -l plot -d 'Write a plot of the motion: NAME.svg, or a page to look closer, NAME.html' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand plan" -l longest -d 'Refuse programs whose feeds and dwells take longer than that; such as 90s, 10min, 8h or 30d' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand plan" -l allow-unchecked -d 'Take a program whose loops go on for too long to be checked to their end (20 million lines): what it does behind that is judged only when it comes to it'
complete -c glidepath -n "__fish_glidepath_using_subcommand plan" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand plan" -l force -d 'Overwrite files that are not of the kind that is written; never one that is read'
complete -c glidepath -n "__fish_glidepath_using_subcommand plan" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand check" -l tool-table -d 'Tool table (LinuxCNC\'s .tbl); overrides `program.tool_table` of the configuration' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand check" -l subroutine-path -d 'Folder to look in for subroutines in files of their own, behind that of the program; may be given several times, and comes before `program.subroutine_path` of the configuration' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand check" -l dialect -d 'Language of the program: linuxcnc, marlin, fanuc or siemens; else told by its beginning' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand check" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand check" -l allow-unchecked -d 'Take a program whose loops go on for too long to be checked to their end (20 million lines): what it does behind that is judged only when it comes to it'
complete -c glidepath -n "__fish_glidepath_using_subcommand check" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand check" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand interpolator" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand interpolator" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand interpolator" -l end-with -d 'End when the process with this number, which started this one, ends' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand interpolator" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand interpolator" -l best-effort -d 'Move without real-time privileges too'
complete -c glidepath -n "__fish_glidepath_using_subcommand interpolator" -l expect-drives -d 'Expect drives to answer, whatever the configuration says'
complete -c glidepath -n "__fish_glidepath_using_subcommand interpolator" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand planner" -l tool-table -d 'Tool table (LinuxCNC\'s .tbl); overrides `program.tool_table` of the configuration' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand planner" -l subroutine-path -d 'Folder to look in for subroutines in files of their own, behind that of the program; may be given several times, and comes before `program.subroutine_path` of the configuration' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand planner" -l dialect -d 'Language of the program: linuxcnc, marlin, fanuc or siemens; else told by its beginning' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand planner" -l effort -d 'optimal or fast; overrides `path.effort` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand planner" -l tolerance -d 'How far the motion may leave the programmed path, mm; overrides `path.tolerance` of the configuration, as G64 P of the program overrides both' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand planner" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand planner" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand planner" -l end-with -d 'End when the process with this number, which started this one, ends' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand planner" -l listen -d 'Be the service of the machine: execute lines (`mdi`), programs (`run-file`) and segments of other processes (`feed`), one at a time'
complete -c glidepath -n "__fish_glidepath_using_subcommand planner" -l resume -d 'Go on with the program from where the machine stands on its path'
complete -c glidepath -n "__fish_glidepath_using_subcommand planner" -l allow-unchecked -d 'Take a program whose loops go on for too long to be checked to their end (20 million lines): what it does behind that is judged only when it comes to it'
complete -c glidepath -n "__fish_glidepath_using_subcommand planner" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand planner" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c glidepath -n "__fish_glidepath_using_subcommand run-file" -l from-line -d 'Begin with this line, as if all before it had been executed' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand run-file" -l pass -d 'At which of the times that the line is executed' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand run-file" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand run-file" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand run-file" -l yes -d 'Agree to what would be asked'
complete -c glidepath -n "__fish_glidepath_using_subcommand run-file" -l resume -d 'Go on with this program where it was left, after an abort or a fault'
complete -c glidepath -n "__fish_glidepath_using_subcommand run-file" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand run-file" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c glidepath -n "__fish_glidepath_using_subcommand mdi" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand mdi" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand mdi" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand mdi" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l setpoints -d 'Write the setpoints received as CSV' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l stands -d 'Where the joints of its machine stand at the start, mm or degrees, such as 12.5,-3,40; where programs begin if not given' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l probe -d 'Imitate a probe, which touches where a joint is at a position or below: J2=-10. Its contact is input 0' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l hal-period-us -d 'The period of the thread of HAL, µs' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l hal-prefill -d 'How many periods HAL is behind the setpoints, and this process may be late by' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l hal-wait-us -d 'How late setpoints may come, µs: HAL plays them so much later; a period of theirs if not given' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l hal-channel -d 'The number of `streamer` and `sampler`' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l end-with -d 'End when the process with this number, which started this one, ends' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l hal -d 'Play on LinuxCNC\'s HAL: lines for `streamer`, feedback from `sampler`'
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l force -d 'Overwrite files that are not of the kind that is written; never one that is read'
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l listens -d 'Move nothing and send no feedback: another stack has the drives'
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -l relay -d 'Write every record received to standard output, for the process that started this one'
complete -c glidepath -n "__fish_glidepath_using_subcommand servo" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -l drives -d 'What hangs on the bus, and which joint each drive moves' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -l cpu -d 'CPU the thread of the bus is pinned to' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -l priority -d 'SCHED_FIFO priority of the thread of the bus, 1 to 99' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -l emulated-period-us -d 'Period of the bus to the emulated drives, µs' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -l emulated-record -d 'Write what the emulated drives recorded at every SYNC0 as CSV' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -l end-with -d 'End when the process with this number, which started this one, ends' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -l best-effort -d 'Drive without real-time privileges too'
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -l emulated -d 'Drive drives that are not there, over a pair of virtual interfaces in a network namespace of their own; without --drives three drives, or as many as the machine has joints'
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -l in-namespace -d 'It is in its namespace already'
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -f -a "scan" -d 'List what hangs on the wire, as a first drives.toml; nothing moves'
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and not __fish_seen_subcommand_from scan help" -f -a "help" -d 'Print this message or the help of the given subcommand(s)'
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and __fish_seen_subcommand_from scan" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and __fish_seen_subcommand_from scan" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and __fish_seen_subcommand_from help" -f -a "scan" -d 'List what hangs on the wire, as a first drives.toml; nothing moves'
complete -c glidepath -n "__fish_glidepath_using_subcommand ethercat; and __fish_seen_subcommand_from help" -f -a "help" -d 'Print this message or the help of the given subcommand(s)'
complete -c glidepath -n "__fish_glidepath_using_subcommand feed" -l tool-table -d 'Tool table (LinuxCNC\'s .tbl); overrides `program.tool_table` of the configuration' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand feed" -l subroutine-path -d 'Folder to look in for subroutines in files of their own, behind that of the program; may be given several times, and comes before `program.subroutine_path` of the configuration' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand feed" -l dialect -d 'Language of the program: linuxcnc, marlin, fanuc or siemens; else told by its beginning' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand feed" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand feed" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand feed" -l allow-unchecked -d 'Take a program whose loops go on for too long to be checked to their end (20 million lines): what it does behind that is judged only when it comes to it'
complete -c glidepath -n "__fish_glidepath_using_subcommand feed" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand feed" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand status" -l every -d 'Time between two looks' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand status" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand status" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand status" -l watch -d 'Show it again and again until Ctrl-C; with --json one object a line'
complete -c glidepath -n "__fish_glidepath_using_subcommand status" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand status" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand live" -l port -d 'The port on 127.0.0.1; 0 takes any that is free' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand live" -l may -d 'What the page may: look; hold and abort; or operate the machine' -r -f -a "look\t'See the machine'
hold\t'Bring it to rest, too: hold and abort'
operate\t'Do whatever an operator does'"
complete -c glidepath -n "__fish_glidepath_using_subcommand live" -l programs -d 'Folder of the programs that the page lists, runs and puts there' -r -f -a "(__fish_complete_directories)"
complete -c glidepath -n "__fish_glidepath_using_subcommand live" -l tool-table -d 'Tool table (LinuxCNC\'s .tbl); overrides `program.tool_table` of the configuration' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand live" -l subroutine-path -d 'Folder to look in for subroutines in files of their own, behind that of the program; may be given several times, and comes before `program.subroutine_path` of the configuration' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand live" -l dialect -d 'Language of the program: linuxcnc, marlin, fanuc or siemens; else told by its beginning' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand live" -l effort -d 'optimal or fast; overrides `path.effort` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand live" -l tolerance -d 'How far the motion may leave the programmed path, mm; overrides `path.tolerance` of the configuration, as G64 P of the program overrides both' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand live" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand live" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand live" -l allow-unchecked -d 'Take a program whose loops go on for too long to be checked to their end (20 million lines): what it does behind that is judged only when it comes to it'
complete -c glidepath -n "__fish_glidepath_using_subcommand live" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand live" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c glidepath -n "__fish_glidepath_using_subcommand grbl" -l port -d 'The TCP port on 127.0.0.1, 2323 if no pseudo-terminal is asked for; 0 takes any that is free' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand grbl" -l pty -d 'A link to be made to a pseudo-terminal, for senders that open serial ports' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand grbl" -l user -d 'Another user, by number, whose programs may connect by TCP besides this one\'s and root\'s' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand grbl" -l ahead -d 'Seconds of motion that are planned before a line has to wait for its ok' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand grbl" -l rx-bytes -d 'Bytes that a sender may have unanswered' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand grbl" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand grbl" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand grbl" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand grbl" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand record" -l program -d 'The program that runs, to be part of the recording: `audit` then judges by it' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand record" -l ring -d 'Be a black box: keep the last minutes in memory, and write them when a fault stops the machine, to FILE with the time in its name; such as 10min or 90s' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand record" -l seconds -d 'End after so many seconds; without it, when asked to' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand record" -l effort -d 'optimal or fast; overrides `path.effort` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand record" -l tolerance -d 'How far the motion may leave the programmed path, mm; overrides `path.tolerance` of the configuration, as G64 P of the program overrides both' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand record" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand record" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand record" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand record" -l force -d 'Overwrite files that are not of the kind that is written; never one that is read'
complete -c glidepath -n "__fish_glidepath_using_subcommand record" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand replay" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand replay" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand replay" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand replay" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand audit" -l program -d 'The program that it has to follow; a recording may have one of its own' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand audit" -l tool-table -d 'Tool table (LinuxCNC\'s .tbl); overrides `program.tool_table` of the configuration' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand audit" -l subroutine-path -d 'Folder to look in for subroutines in files of their own, behind that of the program; may be given several times, and comes before `program.subroutine_path` of the configuration' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand audit" -l dialect -d 'Language of the program: linuxcnc, marlin, fanuc or siemens; else told by its beginning' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand audit" -l effort -d 'optimal or fast; overrides `path.effort` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand audit" -l tolerance -d 'How far the motion may leave the programmed path, mm; overrides `path.tolerance` of the configuration, as G64 P of the program overrides both' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand audit" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand audit" -l allow-unchecked -d 'Take a program whose loops go on for too long to be checked to their end (20 million lines): what it does behind that is judged only when it comes to it'
complete -c glidepath -n "__fish_glidepath_using_subcommand audit" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand audit" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand telemetry" -l broker -d 'The broker, as HOST or HOST:PORT' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand telemetry" -l topic -d 'What topics begin with: TOPIC/INSTANCE/status and so on' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand telemetry" -l user -d 'User at the broker; the password is taken from the environment, GLIDEPATH_MQTT_PASSWORD' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand telemetry" -l rate -d 'Messages a second about a machine that moves' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand telemetry" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand telemetry" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand telemetry" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand telemetry" -s h -l help -d 'Print help'
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
complete -c glidepath -n "__fish_glidepath_using_subcommand override" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand override" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand override" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand override" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand jog" -l feed -d 'How fast along the way, in mm/min or °/min; not above the jog\'s speed of any axis' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand jog" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand jog" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand jog" -l by-joint -d 'The letters mean the joints of these axes, of a machine whose joints are its axes'
complete -c glidepath -n "__fish_glidepath_using_subcommand jog" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand jog" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand return" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand return" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand return" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand return" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand acknowledge" -l fail -d 'What the event asked for has failed: the reason, for people' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand acknowledge" -l event -d 'Only this event, as `awaited` of `status --json` has it: EPOCH/SEQUENCE' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand acknowledge" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand acknowledge" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand acknowledge" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand acknowledge" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand abort" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand abort" -l instance -d 'Name of the machine\'s shared memory; overrides `link.instance` of the configuration' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand abort" -l signal -d 'By SIGTERM: needs no shared memory, and the interpolator ends. The last resort'
complete -c glidepath -n "__fish_glidepath_using_subcommand abort" -l no-lift -d 'Do not take the tool axis up by `jog.lift` of the configuration'
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
complete -c glidepath -n "__fish_glidepath_using_subcommand home" -l no-wait -d 'Return when the drives were told, without waiting for the end'
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
advance-retreat\t'By growing steps, and back where they meet something'
certified\t'By bounds and roots of polynomials: misses nothing'"
complete -c glidepath -n "__fish_glidepath_using_subcommand preview" -l period-us -d 'Period of a setpoint, µs' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand preview" -l feed -d 'Feedrate, mm/min' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand preview" -l chord-error -d 'Chord error of one tick, mm; without it the path tolerance' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand preview" -l plot -d 'Write a plot of the curve, coloured by the speed it allows (SVG)' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand preview" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand preview" -l force -d 'Overwrite files that are not of the kind that is written; never one that is read'
complete -c glidepath -n "__fish_glidepath_using_subcommand preview" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c glidepath -n "__fish_glidepath_using_subcommand bench" -l config-dir -d 'Folder with the configuration of each machine that the catalogue names, such as mill.toml; without it the built-in ones' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand bench" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand bench" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand bench" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand fit" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand fit" -l tolerance -d 'Largest distance between curve and lines, both ways, mm' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand fit" -l method -d 'How to find the curve' -r -f -a "least-squares\t'Knots step by step, control points by least squares'
foraging\t'Control points by bacterial foraging, as published'
hybrid\t'Knots by bacterial foraging, control points by least squares'"
complete -c glidepath -n "__fish_glidepath_using_subcommand fit" -l seed -d 'Seed of the search; the same seed gives the same curve' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand fit" -l output -d 'Write the result: a curve file (.toml, of one run) or a program (.ngc)' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand fit" -l plot -d 'Write a plot of the curves with their control points (SVG)' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand fit" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand fit" -l force -d 'Overwrite files that are not of the kind that is written; never one that is read'
complete -c glidepath -n "__fish_glidepath_using_subcommand fit" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and not __fish_seen_subcommand_from show set use import export adopt recover help" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and not __fish_seen_subcommand_from show set use import export adopt recover help" -f -a "show" -d 'Show everything that is kept'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and not __fish_seen_subcommand_from show set use import export adopt recover help" -f -a "set" -d 'Set a coordinate system, or the position of G28 or G30, or the offset of G92 that is kept'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and not __fish_seen_subcommand_from show set use import export adopt recover help" -f -a "use" -d 'Choose the coordinate system that programs begin in'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and not __fish_seen_subcommand_from show set use import export adopt recover help" -f -a "import" -d 'Take over coordinates from LinuxCNC\'s parameter file (.var)'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and not __fish_seen_subcommand_from show set use import export adopt recover help" -f -a "export" -d 'Print coordinates as LinuxCNC\'s parameter file'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and not __fish_seen_subcommand_from show set use import export adopt recover help" -f -a "adopt" -d 'Take over for this machine what is kept of one with other axes or kinematics'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and not __fish_seen_subcommand_from show set use import export adopt recover help" -f -a "recover" -d 'After a file was damaged: take the newest generation that is whole'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and not __fish_seen_subcommand_from show set use import export adopt recover help" -f -a "help" -d 'Print this message or the help of the given subcommand(s)'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from show" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from show" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from show" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from set" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from set" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from set" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from use" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from use" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from use" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from import" -l linear-units -d '`LINEAR_UNITS` of `[TRAJ]` in LinuxCNC\'s machine configuration' -r -f -a "mm\t'Millimetres'
inch\t'Inches'"
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from import" -l angular-units -d '`ANGULAR_UNITS` of `[TRAJ]`' -r -f -a "degree\t'Degrees'
radian\t'Radians'
grad\t'Gradians: 400 in a turn'"
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from import" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from import" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from import" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from export" -l linear-units -d '`LINEAR_UNITS` of `[TRAJ]` in LinuxCNC\'s machine configuration' -r -f -a "mm\t'Millimetres'
inch\t'Inches'"
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from export" -l angular-units -d '`ANGULAR_UNITS` of `[TRAJ]`' -r -f -a "degree\t'Degrees'
radian\t'Radians'
grad\t'Gradians: 400 in a turn'"
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from export" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from export" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from export" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from adopt" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from adopt" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from adopt" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from recover" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from recover" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from recover" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from help" -f -a "show" -d 'Show everything that is kept'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from help" -f -a "set" -d 'Set a coordinate system, or the position of G28 or G30, or the offset of G92 that is kept'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from help" -f -a "use" -d 'Choose the coordinate system that programs begin in'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from help" -f -a "import" -d 'Take over coordinates from LinuxCNC\'s parameter file (.var)'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from help" -f -a "export" -d 'Print coordinates as LinuxCNC\'s parameter file'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from help" -f -a "adopt" -d 'Take over for this machine what is kept of one with other axes or kinematics'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from help" -f -a "recover" -d 'After a file was damaged: take the newest generation that is whole'
complete -c glidepath -n "__fish_glidepath_using_subcommand offsets; and __fish_seen_subcommand_from help" -f -a "help" -d 'Print this message or the help of the given subcommand(s)'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and not __fish_seen_subcommand_from from-linuxcnc from-grbl from-klipper help" -l explain -d 'Explain a key, all keys of a table, or every key: meaning, unit, range, default' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and not __fish_seen_subcommand_from from-linuxcnc from-grbl from-klipper help" -l check -d 'List everything that has to be mended in a configuration' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and not __fish_seen_subcommand_from from-linuxcnc from-grbl from-klipper help" -l default -d 'Print the built-in machine as a configuration, with every key explained'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and not __fish_seen_subcommand_from from-linuxcnc from-grbl from-klipper help" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and not __fish_seen_subcommand_from from-linuxcnc from-grbl from-klipper help" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and not __fish_seen_subcommand_from from-linuxcnc from-grbl from-klipper help" -f -a "from-linuxcnc" -d 'From LinuxCNC\'s machine configuration'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and not __fish_seen_subcommand_from from-linuxcnc from-grbl from-klipper help" -f -a "from-grbl" -d 'From grbl\'s or grblHAL\'s settings, as `$$` and `$#` print them'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and not __fish_seen_subcommand_from from-linuxcnc from-grbl from-klipper help" -f -a "from-klipper" -d 'From Klipper\'s printer.cfg'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and not __fish_seen_subcommand_from from-linuxcnc from-grbl from-klipper help" -f -a "help" -d 'Print this message or the help of the given subcommand(s)'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and __fish_seen_subcommand_from from-linuxcnc" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and __fish_seen_subcommand_from from-linuxcnc" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and __fish_seen_subcommand_from from-grbl" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and __fish_seen_subcommand_from from-grbl" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and __fish_seen_subcommand_from from-klipper" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and __fish_seen_subcommand_from from-klipper" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and __fish_seen_subcommand_from help" -f -a "from-linuxcnc" -d 'From LinuxCNC\'s machine configuration'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and __fish_seen_subcommand_from help" -f -a "from-grbl" -d 'From grbl\'s or grblHAL\'s settings, as `$$` and `$#` print them'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and __fish_seen_subcommand_from help" -f -a "from-klipper" -d 'From Klipper\'s printer.cfg'
complete -c glidepath -n "__fish_glidepath_using_subcommand config; and __fish_seen_subcommand_from help" -f -a "help" -d 'Print this message or the help of the given subcommand(s)'
complete -c glidepath -n "__fish_glidepath_using_subcommand doctor" -l interface -d 'Look at a network interface that drives hang on, too' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand doctor" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand doctor" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand doctor" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand jitter" -s c -l config -d 'Machine configuration (TOML); without it the built-in 3-axis mill' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand jitter" -l period-us -d 'Period of the loop, µs' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand jitter" -l seconds -d 'How long to measure, s' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand jitter" -l cpu -d 'CPU the loop is pinned to' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand jitter" -l priority -d 'SCHED_FIFO priority, 1 to 99' -r
complete -c glidepath -n "__fish_glidepath_using_subcommand jitter" -l plot -d 'Write a plot of the latency (SVG)' -r -F
complete -c glidepath -n "__fish_glidepath_using_subcommand jitter" -l json -d 'Print one JSON object instead of text'
complete -c glidepath -n "__fish_glidepath_using_subcommand jitter" -l best-effort -d 'Measure without real-time privileges too'
complete -c glidepath -n "__fish_glidepath_using_subcommand jitter" -l full-tick -d 'Do the interpolator\'s work in every period, on a synthetic motion'
complete -c glidepath -n "__fish_glidepath_using_subcommand jitter" -l against-cyclictest -d 'Run cyclictest in the same time on the same CPU, half a period apart, and compare'
complete -c glidepath -n "__fish_glidepath_using_subcommand jitter" -l force -d 'Overwrite files that are not of the kind that is written; never one that is read'
complete -c glidepath -n "__fish_glidepath_using_subcommand jitter" -s h -l help -d 'Print help'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "run" -d 'Plan a program, play it with a mock servo, and report'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "plan" -d 'Compute the same motion without waiting for the clock'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "check" -d 'List everything wrong with programs; no motion'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "interpolator" -d 'The real-time process: frames in, setpoints out'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "planner" -d 'The planner process: a program, standard input, or segments of other processes to frames'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "run-file" -d 'Have the planner\'s service execute a program'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "mdi" -d 'Have the planner\'s service execute a line'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "servo" -d 'A servo: plays setpoints on a machine that is not there, or on LinuxCNC\'s HAL'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "ethercat" -d 'Drives on EtherCAT: setpoints to targets, and where the joints are back'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "feed" -d 'Stream a program\'s segments to a listening planner, as another program would'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "status" -d 'Show the state of a running interpolator'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "live" -d 'Show the machine in a browser of this host, and operate it there if that is allowed'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "grbl" -d 'Let senders of grbl (CNCjs, bCNC, gSender, UGS) drive the machine, by TCP or a pseudo-terminal'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "record" -d 'Record every setpoint and status in a file that others can open (MCAP), or be a black box'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "replay" -d 'Play a recording into a servo stack, in place of an interpolator'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "audit" -d 'Judge a recording or a CSV file of setpoints: limits, order, gaps, and the path by its program'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "telemetry" -d 'Tell an MQTT broker what the machine does'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "hold" -d 'Feed hold: come to rest on the path'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "resume" -d 'Go on after a hold, a program stop or the end of a block'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "step" -d 'Go on to the end of the block, and rest there'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "stop-at-block-end" -d 'Come to rest at the end of the present block, or of the first at which that is possible'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "reverse" -d 'Go back along the path that was run: at most a minute, and not past what cannot be undone'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "forward" -d 'Go onward along the path, after `reverse`'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "single-block" -d 'Rest at the end of every block, or do so no longer; `resume` or `step` goes on'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "override" -d 'Set the override of the feed, of rapids, or of jogs'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "jog" -d 'Move axes by hand: by steps, or by the keys of the terminal'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "return" -d 'Go back to the path, after a jog in a hold'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "acknowledge" -d 'Say that what an M code asked for is done, or has failed: the motion waits for it'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "abort" -d 'Come to rest on the path and drop the rest of the program'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "reset" -d 'Take note of a fault, whatever its cause: the machine is idle again'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "enable" -d 'Give the drives power, and take the position over from them'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "disable" -d 'Come to rest on the path, drop the rest of the program, and take the power from the drives'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "home" -d 'Have drives find the home of their joints, and wait for that'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "unhome" -d 'Make joints count as not homed'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "set-position" -d 'Give the present position of a joint another number'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "preview" -d 'Find where a NURBS is too sharp for its feedrate'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "bench" -d 'Plan the benchmark programs, and compare with what is known of them'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "fit" -d 'Fit NURBS to the dense runs of short lines of a program'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "offsets" -d 'What the machine keeps over a restart: work offsets, G28, G30, G92, tools'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "config" -d 'The configuration: print one, explain its keys, check one, convert one of another control'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "doctor" -d 'Is this host fit for real time? With the fix for each no'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "jitter" -d 'Measure how late the real-time loop wakes on this host'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and not __fish_seen_subcommand_from run plan check interpolator planner run-file mdi servo ethercat feed status live grbl record replay audit telemetry hold resume step stop-at-block-end reverse forward single-block override jog return acknowledge abort reset enable disable home unhome set-position preview bench fit offsets config doctor jitter help" -f -a "help" -d 'Print this message or the help of the given subcommand(s)'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and __fish_seen_subcommand_from ethercat" -f -a "scan" -d 'List what hangs on the wire, as a first drives.toml; nothing moves'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and __fish_seen_subcommand_from offsets" -f -a "show" -d 'Show everything that is kept'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and __fish_seen_subcommand_from offsets" -f -a "set" -d 'Set a coordinate system, or the position of G28 or G30, or the offset of G92 that is kept'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and __fish_seen_subcommand_from offsets" -f -a "use" -d 'Choose the coordinate system that programs begin in'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and __fish_seen_subcommand_from offsets" -f -a "import" -d 'Take over coordinates from LinuxCNC\'s parameter file (.var)'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and __fish_seen_subcommand_from offsets" -f -a "export" -d 'Print coordinates as LinuxCNC\'s parameter file'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and __fish_seen_subcommand_from offsets" -f -a "adopt" -d 'Take over for this machine what is kept of one with other axes or kinematics'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and __fish_seen_subcommand_from offsets" -f -a "recover" -d 'After a file was damaged: take the newest generation that is whole'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and __fish_seen_subcommand_from config" -f -a "from-linuxcnc" -d 'From LinuxCNC\'s machine configuration'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and __fish_seen_subcommand_from config" -f -a "from-grbl" -d 'From grbl\'s or grblHAL\'s settings, as `$$` and `$#` print them'
complete -c glidepath -n "__fish_glidepath_using_subcommand help; and __fish_seen_subcommand_from config" -f -a "from-klipper" -d 'From Klipper\'s printer.cfg'
