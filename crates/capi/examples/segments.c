/* Streams a square to a planner that listens, from where the machine stands.
 *
 *     glidepath planner --listen &
 *     cc -std=c11 segments.c -lglidepath -o segments
 *     ./segments default 20 50
 *
 * The second argument is the length of its sides in mm, the third the feedrate in mm/s.
 */
#define _POSIX_C_SOURCE 200809L
#include <glidepath.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static int fail(const char *what) {
    char why[513];
    gp_last_error(why, sizeof why);
    fprintf(stderr, "segments: %s: %s\n", what, why);
    return 1;
}

/* Sends a piece, and waits where the planner has no room or is slow to answer. */
static int send_piece(gp_segments *stream, const gp_segment *piece, gp_segment_reply *reply) {
    for (;;) {
        const int sent = gp_segments_send(stream, piece, sizeof *piece, 1000, reply, sizeof *reply);
        if (sent > 0)
            return 0;
        const int waits =
            sent == 0 ||
            (sent == GP_E_REFUSED && reply->refusal == GP_SEGMENT_REFUSAL_NO_CREDIT);
        if (!waits)
            return fail("not accepted");
        const struct timespec moment = {0, 2000000};
        nanosleep(&moment, NULL);
    }
}

static int square(gp_segments *stream, double side, double feed) {
    static const int corners[4][2] = {{1, 0}, {1, 1}, {0, 1}, {0, 0}};
    gp_segment_reply reply;
    gp_segment piece = {.kind = GP_SEGMENT_OPEN};
    if (send_piece(stream, &piece, &reply))
        return 1;
    double start[GP_AXES];
    memcpy(start, reply.position, sizeof start);
    piece = (gp_segment){.kind = GP_SEGMENT_LINE, .mode = GP_PATH_CONTINUOUS, .feed_v = feed};
    memcpy(piece.end, start, sizeof piece.end);
    for (uint32_t corner = 0; corner < 4; ++corner) {
        memcpy(piece.start, piece.end, sizeof piece.start);
        piece.end[0] = start[0] + side * corners[corner][0];
        piece.end[1] = start[1] + side * corners[corner][1];
        piece.line = corner + 1;
        if (send_piece(stream, &piece, &reply))
            return 1;
    }
    piece = (gp_segment){.kind = GP_SEGMENT_END};
    return send_piece(stream, &piece, &reply);
}

int main(int count, char **arguments) {
    if (count != 4) {
        fprintf(stderr, "usage: segments INSTANCE SIDE FEED\n");
        return 2;
    }
    gp_link *link = NULL;
    gp_segments *stream = NULL;
    if (gp_open(arguments[1], &link) < 0 || gp_segments_open(link, &stream) < 0)
        return fail("not opened");
    const int failed = square(stream, atof(arguments[2]), atof(arguments[3]));
    if (gp_segments_close(stream) < 0 || gp_close(link) < 0)
        return fail("not closed");
    if (!failed)
        printf("4 segments accepted\n");
    return failed;
}
