/* A servo stack in small: a thread that plays setpoints a thousand times a second, as a real-time
 * thread would, and another one that says where the drives are.
 *
 *     cc -std=c11 -pthread servo.c -lglidepath -o servo
 *     ./servo default 10
 *
 * The second argument is for how many seconds; a third one is how many milliseconds without a
 * setpoint it bears. The drives here are exact: they stand where they were told to.
 */
#define _POSIX_C_SOURCE 200809L
#include <glidepath.h>

#include <inttypes.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define CYCLE_NS 1000000

/* What the threads share. A real stack has its process image here. */
static struct {
    gp_servo *servo;
    uint64_t end_ns;
    _Atomic double position[GP_AXES];
    _Atomic uint64_t sample_ns, reference, number;
    _Atomic uint32_t enable;
    atomic_int failed;
    atomic_bool over;
} shared;

static void fail(const char *what) {
    char why[513];
    gp_last_error(why, sizeof why);
    fprintf(stderr, "servo: %s: %s\n", what, why);
}

/* No system call but the sleep, no allocation, no lock. */
static void *play(void *unused) {
    (void)unused;
    uint64_t cycle_ns = gp_now_ns();
    while (cycle_ns < shared.end_ns) {
        cycle_ns += CYCLE_NS;
        const struct timespec next = {(time_t)(cycle_ns / 1000000000u),
                                      (long)(cycle_ns % 1000000000u)};
        clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &next, NULL);
        const uint64_t now_ns = gp_now_ns();
        gp_setpoint setpoint;
        int got;
        while ((got = gp_servo_receive(shared.servo, now_ns, &setpoint, sizeof setpoint)) > 0) {
            atomic_store(&shared.reference, setpoint.reference);
            atomic_store(&shared.number, setpoint.number);
            atomic_store(&shared.enable, setpoint.enable);
        }
        gp_joint joints[GP_AXES];
        if (got == 0) {
            got = gp_servo_demand(shared.servo, now_ns, joints, sizeof joints);
        }
        if (got < 0) {
            atomic_store(&shared.failed, 1);
            fail("playing");
            break;
        }
        if (got > 0) { /* Else the drives are to stay where they are. */
            for (int joint = 0; joint < GP_AXES; joint++) {
                atomic_store(&shared.position[joint], joints[joint].position);
            }
        }
        atomic_store(&shared.sample_ns, now_ns);
    }
    gp_servo_release(shared.servo); /* For whoever closes it. */
    atomic_store(&shared.over, 1);
    return NULL;
}

/* What a stack knows of its drives; these are always on, and homed. */
static gp_feedback measured(void) {
    gp_feedback feedback;
    memset(&feedback, 0, sizeof feedback);
    feedback.sample_ns = atomic_load(&shared.sample_ns);
    feedback.reference = atomic_load(&shared.reference);
    feedback.setpoint_number = atomic_load(&shared.number);
    feedback.joints = 0x7;
    feedback.enabled = atomic_load(&shared.enable) & feedback.joints;
    feedback.homed = feedback.joints;
    for (int joint = 0; joint < 3; joint++) {
        feedback.position[joint] = atomic_load(&shared.position[joint]);
        feedback.drive_state[joint] = GP_DRIVE_OPERATION_ENABLED;
    }
    return feedback;
}

int main(int argc, char **argv) {
    if (argc != 3 && argc != 4) {
        fprintf(stderr, "usage: servo INSTANCE SECONDS [PATIENCE_MS]\n");
        return 1;
    }
    gp_link *link = NULL;
    gp_feedback_sink *sink = NULL;
    gp_servo_settings settings;
    if (gp_open(argv[1], &link) < 0) {
        fail("gp_open");
        return 1;
    }
    gp_servo_settings_default(&settings, sizeof settings);
    if (argc == 4) {
        settings.patience_ns = strtoull(argv[3], NULL, 10) * 1000000u;
    }
    for (int joint = 0; joint < 3; joint++) { /* Above 300 mm/s and 2000 mm/s^2 it is a jump. */
        settings.jump[joint].velocity = 1.2 * 300.0;
        settings.jump[joint].acceleration = 2.0 * 2000.0;
    }
    if (gp_servo_open(link, &settings, sizeof settings, &shared.servo) < 0 ||
        gp_feedback_open(link, &sink) < 0) {
        fail("opening");
        return 1;
    }
    /* These drives stand at zero, and begin where setpoints do. */
    double actual[GP_AXES] = {0}, window[GP_AXES];
    for (int joint = 0; joint < GP_AXES; joint++) {
        window[joint] = INFINITY;
    }
    if (gp_servo_rearm_at(shared.servo, actual, window) < 0 || gp_servo_release(shared.servo) < 0) {
        fail("gp_servo_rearm_at");
        return 1;
    }
    shared.end_ns = gp_now_ns() + (uint64_t)(strtod(argv[2], NULL) * 1e9);
    pthread_t thread;
    if (pthread_create(&thread, NULL, play, NULL) != 0) {
        perror("servo");
        return 1;
    }
    printf("ready\n");
    fflush(stdout);
    const struct timespec cycle = {0, CYCLE_NS};
    while (!atomic_load(&shared.over)) {
        nanosleep(&cycle, NULL);
        const gp_feedback feedback = measured();
        if (feedback.sample_ns > 0 && gp_feedback_send(sink, &feedback, sizeof feedback) < 0) {
            fail("gp_feedback_send");
            return 1;
        }
    }
    pthread_join(thread, NULL);

    gp_servo_state state;
    if (gp_servo_read_state(shared.servo, &state, sizeof state) < 0) {
        fail("gp_servo_read_state");
        return 1;
    }
    printf("%" PRIu64 " received, %" PRIu64 " lost, %" PRIu64 " jumps, %" PRIu64 " own stop%s, "
           "stopped %" PRIu32 ", at %.6f\n",
           state.received, state.lost, state.jumps, state.stops, state.stops == 1 ? "" : "s", state.stopped,
           atomic_load(&shared.position[0]));
    if (gp_servo_close(shared.servo) < 0 || gp_feedback_close(sink) < 0 || gp_close(link) < 0) {
        fail("closing");
        return 1;
    }
    return atomic_load(&shared.failed);
}
