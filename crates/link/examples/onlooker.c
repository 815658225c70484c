/* The smallest reader of the mirror in C, which is C++ as well: iceoryx2's own binding (0.10), and the layout of a record,
 * for which glidepath.h is enough. It needs no library of Glidepath.
 *
 *     cc -I crates/capi/include -I IOX2/include onlooker.c -L IOX2/lib -liceoryx2_ffi_c -o onlooker
 *     ./onlooker default [ROOT]
 *
 * IOX2 is where iceoryx2 was installed. The first word is the name of the instance, the second the root of iceoryx2's domain,
 * if the mirror was given one. Prints what the example in Rust (onlooker.rs) prints, and ends five seconds after the last
 * setpoint. It is for looking on: any program of the same user can publish there in the mirror's place. */

#include "glidepath.h"
#include "iox2/iceoryx2.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

/* What iceoryx2 compares, with size and alignment. */
static const char TYPE[] = "glidepath.SetpointMirror.v6";

/* Milliseconds without a setpoint, after which nobody waits any more. */
enum { PATIENCE = 5000 };

static int failed(const char *what) {
    fprintf(stderr, "%s failed\n", what);
    return 1;
}

static iox2_node_h join(const char *root) {
    iox2_config_h config = NULL;
    iox2_node_h node = NULL;
    iox2_node_builder_h builder = iox2_node_builder_new(NULL);
    if (root != NULL) {
        if (iox2_config_default(NULL, &config) != IOX2_OK
            || iox2_config_global_set_root_path(&config, root) != IOX2_OK) {
            return NULL;
        }
        iox2_node_builder_set_config(&builder, &config);
    }
    if (iox2_node_builder_create(builder, NULL, iox2_service_type_e_IPC, &node) != IOX2_OK) {
        node = NULL;
    }
    if (config != NULL) {
        iox2_config_drop(config);
    }
    return node;
}

static iox2_port_factory_pub_sub_h open_service(iox2_node_h node, const char *instance) {
    char text[256];
    iox2_service_name_h name = NULL;
    iox2_port_factory_pub_sub_h service = NULL;
    const int length = snprintf(text, sizeof text, "glidepath/%s/setpoints", instance);
    if (length < 0 || (size_t)length >= sizeof text
        || iox2_service_name_new(NULL, text, (size_t)length, &name) != IOX2_OK) {
        return NULL;
    }
    iox2_service_builder_h builder = iox2_node_service_builder(&node, NULL, iox2_cast_service_name_ptr(name));
    iox2_service_builder_pub_sub_h pub_sub = iox2_service_builder_pub_sub(builder);
    if (iox2_service_builder_pub_sub_set_payload_type_details(&pub_sub, iox2_type_variant_e_FIXED_SIZE, TYPE,
                                                              strlen(TYPE), sizeof(gp_setpoint), 8) != IOX2_OK
        /* Not open_or_create: what a reader makes has less room than the mirror needs. */
        || iox2_service_builder_pub_sub_open(pub_sub, NULL, &service) != IOX2_OK) {
        service = NULL;
    }
    iox2_service_name_drop(name);
    return service;
}

static int follow(iox2_node_h node, iox2_subscriber_h setpoints) {
    uint64_t boot_id = 0, expected = 0;
    int waited = 0;
    while (waited < PATIENCE) {
        iox2_sample_h sample = NULL;
        const void *payload = NULL;
        gp_setpoint setpoint;
        if (iox2_subscriber_receive(&setpoints, NULL, &sample) != IOX2_OK) {
            return failed("receiving");
        }
        if (sample == NULL) {
            /* Sleeps for a millisecond. */
            if (iox2_node_wait(&node, 0, 1000000) != IOX2_OK) {
                return 0;
            }
            waited += 1;
            continue;
        }
        waited = 0;
        iox2_sample_payload(&sample, &payload, NULL);
        memcpy(&setpoint, payload, sizeof setpoint);
        iox2_sample_drop(sample);
        if (boot_id == setpoint.boot_id && expected < setpoint.number) {
            printf("gap %" PRIu64 " to %" PRIu64 "\n", expected, setpoint.number - 1);
        }
        boot_id = setpoint.boot_id;
        expected = setpoint.number + 1;
        printf("%" PRIu64 " %" PRIu32 " %.17g %.17g %.17g\n", setpoint.number, setpoint.line, setpoint.position[0],
               setpoint.position[1], setpoint.position[2]);
    }
    return 0;
}

int main(int count, char **words) {
    if (count != 2 && count != 3) {
        fprintf(stderr, "usage: onlooker INSTANCE [ROOT]\n");
        return 2;
    }
    iox2_node_h node = join(count == 3 ? words[2] : NULL);
    if (node == NULL) {
        return failed("joining the domain");
    }
    iox2_port_factory_pub_sub_h service = open_service(node, words[1]);
    if (service == NULL) {
        iox2_node_drop(node);
        return failed("opening the service (does a mirror run?)");
    }
    iox2_subscriber_h setpoints = NULL;
    iox2_port_factory_subscriber_builder_h builder = iox2_port_factory_pub_sub_subscriber_builder(&service, NULL);
    int code;
    if (iox2_port_factory_subscriber_builder_create(builder, NULL, &setpoints) == IOX2_OK) {
        printf("ready\n");
        fflush(stdout);
        code = follow(node, setpoints);
        iox2_subscriber_drop(setpoints);
    } else {
        code = failed("subscribing");
    }
    iox2_port_factory_pub_sub_drop(service);
    iox2_node_drop(node);
    return code;
}
