/* Moves an axis by hand: at a velocity, for a time.
 *
 *     cc -std=c11 jog.c -lglidepath -o jog
 *     ./jog default 0 -5 1.5
 *
 * The axis is X for 0, Y for 1, and so on; velocities are mm/s or degrees/s. When this program ends,
 * however it does, the axis comes to rest: a jog that nobody keeps is stopped by the interpolator.
 */
#define _POSIX_C_SOURCE 200809L
#include <glidepath.h>

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

/* Three times as often as the interpolator asks for. */
#define KEEP_NS 50000000

static int fail(const char *what) {
    char why[513];
    gp_last_error(why, sizeof why);
    fprintf(stderr, "jog: %s: %s\n", what, why);
    return 1;
}

static int jog(gp_jog_sink *sink, int axis, double velocity, double seconds) {
    gp_jog demand = {.mode = GP_JOG_MODE_CONTINUOUS, .mask = UINT32_C(1) << axis};
    demand.value[axis] = velocity;
    if (gp_jog_send(sink, &demand, sizeof demand) < 0)
        return fail("not asked");
    const uint64_t end_ns = gp_now_ns() + (uint64_t)(seconds * 1e9);
    while (gp_now_ns() < end_ns) {
        const struct timespec moment = {0, KEEP_NS};
        nanosleep(&moment, NULL);
        if (gp_jog_keep(sink) < 0)
            return fail("not kept");
    }
    return 0;
}

int main(int count, char **arguments) {
    const int axis = count == 5 ? atoi(arguments[2]) : -1;
    if (axis < 0 || axis >= GP_AXES) {
        fprintf(stderr, "usage: jog INSTANCE AXIS VELOCITY SECONDS\n");
        return 2;
    }
    gp_link *link = NULL;
    gp_jog_sink *sink = NULL;
    if (gp_open(arguments[1], &link) < 0 || gp_jog_open(link, &sink) < 0)
        return fail("not opened");
    const int failed = jog(sink, axis, atof(arguments[3]), atof(arguments[4]));
    /* Closing lets go. */
    if (gp_jog_close(sink) < 0 || gp_close(link) < 0)
        return fail("not closed");
    return failed;
}
