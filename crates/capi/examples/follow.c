/* Follows the setpoints of an instance, and writes them to a file as they are.
 *
 *     cc -std=c11 follow.c -lglidepath -o follow
 *     ./follow default 1000 setpoints.bin
 *
 * Ends after so many setpoints, or with 2 after ten seconds without one.
 */
#define _POSIX_C_SOURCE 200809L
#include <glidepath.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static int failed(const char *what) {
    char why[513];
    gp_last_error(why, sizeof why);
    fprintf(stderr, "follow: %s: %s\n", what, why);
    return 1;
}

int main(int argc, char **argv) {
    if (argc != 4) {
        fprintf(stderr, "usage: follow INSTANCE COUNT FILE\n");
        return 1;
    }
    const unsigned long long count = strtoull(argv[2], NULL, 10);
    gp_link *link = NULL;
    gp_setpoints *setpoints = NULL;
    if (gp_open(argv[1], &link) < 0) {
        return failed("gp_open");
    }
    if (gp_setpoints_open(link, &setpoints) < 0) {
        return failed("gp_setpoints_open");
    }
    FILE *file = fopen(argv[3], "wb");
    if (file == NULL) {
        perror(argv[3]);
        return 1;
    }
    printf("ready\n");
    fflush(stdout);

    const struct timespec millisecond = {0, 1000000};
    unsigned long long received = 0, lost = 0;
    uint64_t boot_id = 0, expected = 0, heard_ns = gp_now_ns();
    while (received < count) {
        gp_setpoint setpoint;
        const int got = gp_next(setpoints, &setpoint, sizeof setpoint);
        if (got < 0) {
            return failed("gp_next");
        }
        if (got == 0) {
            /* Setpoints come one period before they are to be applied: there is time to sleep. */
            nanosleep(&millisecond, NULL);
            if (gp_now_ns() - heard_ns > UINT64_C(10000000000)) {
                fprintf(stderr, "follow: %llu setpoints, then none for ten seconds\n", received);
                return 2;
            }
            continue;
        }
        heard_ns = gp_now_ns();
        if (received > 0 && setpoint.boot_id == boot_id) {
            lost += setpoint.number - expected; /* A gap is loss. */
        }
        boot_id = setpoint.boot_id;
        expected = setpoint.number + 1;
        received += 1;
        if (fwrite(&setpoint, sizeof setpoint, 1, file) != 1) {
            perror(argv[3]);
            return 1;
        }
    }
    printf("%llu received, %llu lost\n", received, lost);
    if (gp_setpoints_close(setpoints) < 0 || gp_close(link) < 0) {
        return failed("closing");
    }
    return fclose(file) == 0 ? 0 : 1;
}
