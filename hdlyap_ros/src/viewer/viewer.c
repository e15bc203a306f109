/** The viewer: draws pictures of a run, live or from a bag that is played -> <node>/markers.
 * rosrun hdlyap viewer [_node:=/hdlyap] [_modes:="T(1,0) LP(1,0)"]
 * rosservice call /viewer/set "modes=T(1,0)" */
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "draw.h"
#include "hdlyap_ros/hdlyap_ros.h"
#include "common/nodes.h"

enum { EXIT_REFUSED = 2, EXIT_NO_MEMORY = 3, QUEUE = 1000, TOPIC_SIZE = 300 };

/** How often the viewer checks who listens to its pictures, and who publishes [s]. */
static const double poll_seconds = 0.1;
/** If nobody has listened to the pictures for this time, the viewer unsubscribes. rviz takes a
 * while to open. */
static const double patience_seconds = 10.0;
/** If slow_vectors is not connected after this time, no node publishes it. A bag's player waits
 * until somebody listens to the topics that stand in for it. */
static const double connecting_seconds = 1.0;
/** A picture is sent again after this time, because rviz forgets pictures whose box is not
 * checked. */
static const double again_seconds = 1.0;
/** If the run has sent nothing new for this time, the picture says so. */
static const double still_seconds = 3.0;

/** Number of subscribers that are created and freed together. */
enum { GROUP = 3 };

typedef struct viewer {
    hdr_node *ros;
    const char *node; /**< the node that publishes the run */
    mode_choice modes;
    pthread_mutex_t lock; /**< between callbacks and the main thread, for members up to `since` */
    heard said;
    canvas *on;
    hdr_publisher *markers;
    double heard_at, sent_at; /**< when something new was received, and when a picture was sent */
    time_t since;             /**< wall time at heard_at */
    /* only the main thread uses: */
    hdr_subscriber *live[GROUP];      /**< slow_vectors first */
    hdr_subscriber *stand_ins[GROUP]; /**< state and fields, in place of slow_vectors in a bag */
    double seen, asked; /**< when somebody last listened; when the live subscribers were created */
} viewer;

static double seconds_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* ---- modes --------------------------------------------------------------------------------- */

static const char *const modes_allowed =
    "lowest or 1 to 8 names such as T(1,0) LP(1,1), of spheres T(1,0,0), with spaces between";

/** Reads `lowest`, or 1 to PICTURE_MODES_MAX names with spaces between. Returns false for any other
 * text. */
static bool parse_modes(mode_choice *modes, const char *text)
{
    char name[24];
    int end = 0;
    *modes = (mode_choice){.count = 0};
    if (strcmp(text, "lowest") == 0) return true;
    for (; sscanf(text, "%23s%n", name, &end) == 1; text += end)
        if (modes->count == PICTURE_MODES_MAX ||
            !mode_name_parse(&modes->mode[modes->count++], name))
            return false;
    return modes->count > 0;
}

/* ---- pictures ------------------------------------------------------------------------------- */

/** Writes since when nothing new has come; "" if something has, or the run has ended. */
static void write_note(char *note, size_t size, const viewer *v)
{
    const bool still = seconds_now() - v->heard_at > still_seconds;
    struct tm at;
    note[0] = '\0';
    if (still && v->said.stage != HDR_RUN_STATUS_FINISHED && localtime_r(&v->since, &at))
        strftime(note, size, "(nothing new since %H:%M:%S)", &at);
}

/** Sends the picture of a run that has begun. */
static void send_picture(viewer *v)
{
    char note[48];
    hdr_markers markers;
    write_note(note, sizeof note, v);
    const picture p = picture_of(&v->said, &v->modes, note);
    v->said.changed = false;
    v->sent_at = seconds_now();
    if (!draw(v->on, &markers, &p, "box"))
        hdr_log(HDR_ERROR, "t = %g not drawn: out of memory", v->said.time);
    else if (hdr_markers_publish(v->markers, &markers) != HDR_OK)
        hdr_log(HDR_ERROR, "picture not sent: %s", hdr_error_text());
}

/** Sends a picture if there is something new. */
static void show(viewer *v)
{
    if (!v->said.begun || !v->said.changed) return;
    v->heard_at = seconds_now();
    v->since = time(NULL);
    send_picture(v);
}

/** Sends the last picture again if somebody listens and nothing new has come. Returns whether a run
 * has begun. */
static bool tend(viewer *v)
{
    pthread_mutex_lock(&v->lock);
    const bool begun = v->said.begun;
    if (begun && hdr_publisher_subscribers(v->markers) > 0 &&
        seconds_now() - v->sent_at > again_seconds)
        send_picture(v);
    pthread_mutex_unlock(&v->lock);
    return begun;
}

/* ---- callbacks ------------------------------------------------------------------------------ */

static bool is_looked_for(const hdr_run_info *info, const mode_name *name)
{
    for (uint32_t k = 0; k < info->wave_nx.count && k < info->wave_ny.count; k++) {
        const mode_name wave = {.nx = info->wave_nx.data[k],
                                .ny = info->wave_ny.data[k],
                                .nz = k < info->wave_nz.count ? info->wave_nz.data[k] : 0};
        if (SAME_NODES(&wave, name)) return true;
    }
    return false;
}

static void warn_of_none(const hdr_run_info *info, const mode_name *name)
{
    char nodes[NODES_SIZE];
    nodes_write(nodes, info->dimension == 3, name->nx, name->ny, name->nz);
    hdr_log(HDR_WARN,
            "modes: the scene %s does not look for wave %s: start it with a larger max_mode_number "
            "or max_wave_number, and with observables that need modes",
            heard_parameter(info, "scene"), nodes);
}

static void on_run_info(void *context, const hdr_run_info *info)
{
    viewer *v = context;
    pthread_mutex_lock(&v->lock);
    const bool begins = heard_run_info(&v->said, info);
    show(v);
    pthread_mutex_unlock(&v->lock);
    if (!begins) return;
    for (int k = 0; k < v->modes.count; k++)
        if (!is_looked_for(info, &v->modes.mode[k])) warn_of_none(info, &v->modes.mode[k]);
}

/** Defines the callback on_NAME, which takes a message and does something before and after. */
#define ON(name, before, after)                                                                    \
    static void on_##name(void *context, const hdr_##name *message)                                \
    {                                                                                              \
        viewer *v = context;                                                                       \
        pthread_mutex_lock(&v->lock);                                                              \
        before;                                                                                    \
        heard_##name(&v->said, message);                                                           \
        after;                                                                                     \
        pthread_mutex_unlock(&v->lock);                                                            \
    }
ON(slow_vectors, , show(v))
/* A message of a later time shows that all of the time before has come, even if a bag has no
 * status. */
ON(state, if (message->sim_time != v->said.time) show(v), )
ON(mode_field, if (message->sim_time > v->said.time) show(v), )
ON(steps, , )
ON(lp_phases, , )
ON(run_status, , show(v)) /* the last message of a report */
#undef ON

/** Answers ~set: it can only change the modes, by "modes=T(1,0) LP(1,1)". */
static bool on_set(void *context, const char *assignment, char *message, size_t size)
{
    viewer *v = context;
    mode_choice modes;
    const char *names = assignment + strlen("modes=");
    if (strncmp(assignment, "modes=", strlen("modes=")) != 0) {
        snprintf(message, size, "must be modes=NAMES: other parameters are read at the start");
        return false;
    }
    if (!parse_modes(&modes, names)) {
        snprintf(message, size, "modes = %.80s: must be %s", names, modes_allowed);
        return false;
    }
    pthread_mutex_lock(&v->lock);
    v->modes = modes;
    if (v->said.begun) send_picture(v);
    pthread_mutex_unlock(&v->lock);
    hdr_param_write_string(v->ros, "modes", names);
    snprintf(message, size, "modes = %.80s", names);
    return true;
}

/* ---- topics -------------------------------------------------------------------------------- */

/** The full name of a topic of the node; valid until the next call. */
static const char *topic(const viewer *v, const char *name)
{
    static char text[TOPIC_SIZE];
    snprintf(text, sizeof text, "%s/%s", v->node, name);
    return text;
}

/** Subscribes `to` to a topic if `status`, a variable where this is used, is still HDR_OK. */
#define HEAR(to, name, from, queue)                                                                \
    if (status == HDR_OK)                                                                          \
    status = hdr_##name##_subscribe(to, v->ros, topic(v, from), queue, on_##name, v)

static hdr_status hear_live(viewer *v)
{
    hdr_status status = HDR_OK;
    HEAR(&v->live[1], steps, "steps", QUEUE);
    HEAR(&v->live[2], run_status, "status", QUEUE);
    HEAR(&v->live[0], slow_vectors, "slow_vectors", 1);
    return status;
}

static hdr_status hear_stand_ins(viewer *v)
{
    hdr_status status = HDR_OK;
    HEAR(&v->stand_ins[0], state, "state", QUEUE);
    HEAR(&v->stand_ins[1], lp_phases, "lp_phases", QUEUE);
    HEAR(&v->stand_ins[2], mode_field, "fields", QUEUE);
    return status;
}

static void hear_no_more(hdr_subscriber *group[GROUP])
{
    for (int k = 0; k < GROUP; k++) {
        hdr_subscriber_free(group[k]);
        group[k] = NULL;
    }
}

/** Subscribes while somebody listens to the pictures, because the node computes a topic only while
 * somebody listens to it; to the stand-ins only if slow_vectors is not published. It waits for
 * run_info: messages that a run at rest sends only once would be ignored before. */
static hdr_status follow(viewer *v, double now, bool begun)
{
    hdr_status status = HDR_OK;
    if (hdr_publisher_subscribers(v->markers) > 0) v->seen = now;
    const bool wanted = begun && now - v->seen < patience_seconds;
    if (wanted && !*v->live) {
        v->asked = now;
        status = hear_live(v);
    }
    if (!wanted) hear_no_more(v->live);
    const bool is_live = *v->live && (now - v->asked < connecting_seconds ||
                                      hdr_subscriber_publishers(*v->live) > 0);
    if (!wanted || is_live)
        hear_no_more(v->stand_ins);
    else if (!*v->stand_ins && status == HDR_OK)
        status = hear_stand_ins(v);
    return status;
}

static hdr_status look_after(viewer *v)
{
    hdr_subscriber *info; /* the node frees it at its end */
    hdr_status status = hdr_markers_advertise(&v->markers, v->ros, topic(v, "markers"));
    if (status == HDR_OK) status = hdr_frame_publish(v->ros, "world", "box");
    HEAR(&info, run_info, "run_info", QUEUE);
    if (status == HDR_OK) status = hdr_service_set(v->ros, "~set", on_set, v);
    v->seen = seconds_now();
    while (status == HDR_OK) {
        status = follow(v, seconds_now(), tend(v));
        hdr_node_lost(v->ros); /* logs if the master is lost */
        if (!hdr_node_wait(poll_seconds)) break;
    }
    return status;
}

/* ---- parameters ---------------------------------------------------------------------------- */

static bool refuse(const hdr_params *params, const char *name, const char *allowed)
{
    hdr_log(HDR_FATAL, "%s = %s: must be %s", name, hdr_param_text(params, name), allowed);
    return false;
}

/** Reads the parameter node. A name that does not begin with / is relative to the viewer's
 * namespace. */
static bool read_node(viewer *v, const hdr_params *params)
{
    static char name[TOPIC_SIZE / 2];
    const char *given = "/hdlyap", *own = hdr_node_name(v->ros);
    const hdr_status status = hdr_param_string(params, "node", &given);
    const int space = *given == '/' ? 0 : (int)(strrchr(own, '/') - own) + 1;
    const int length = snprintf(name, sizeof name, "%.*s%s", space, own, given);
    v->node = name;
    return (*given && length < (int)sizeof name && (status == HDR_OK || status == HDR_MISSING)) ||
           refuse(params, "node", "the name of a node, such as /hdlyap");
}

static bool read_modes(mode_choice *modes, const hdr_params *params)
{
    const char *text = NULL;
    const hdr_status status = hdr_param_string(params, "modes", &text);
    return status == HDR_MISSING || (status == HDR_OK && parse_modes(modes, text)) ||
           refuse(params, "modes", modes_allowed);
}

static const char *const known[] = {"node", "modes", NULL};

static bool is_known(const char *name)
{
    const char *const *one = known;
    while (*one && strcmp(*one, name) != 0) one++;
    return *one;
}

static bool read_parameters(viewer *v, const hdr_params *params)
{
    const char *unknown = hdr_params_unknown(params, known);
    hdr_params_warn_of_renaming(params, is_known);
    if (unknown) return refuse(params, unknown, "removed: there is no parameter of this name");
    return read_node(v, params) && read_modes(&v->modes, params);
}

int main(int argc, char **argv)
{
    hdr_params *params = NULL;
    viewer v = {.lock = PTHREAD_MUTEX_INITIALIZER};
    heard_clear(&v.said);
    hdr_status status = hdr_node_create(&v.ros, &argc, argv, "viewer", 1.0, EXIT_NO_MEMORY);
    if (status == HDR_OK && !v.ros) return 0; /* stopped before there was a master */
    if (status == HDR_OK) status = hdr_params_create(&params, v.ros);
    const bool refused = status == HDR_OK && !read_parameters(&v, params);
    if (status == HDR_OK && !refused && !canvas_create(&v.on)) status = HDR_NO_MEMORY;
    if (status == HDR_OK && !refused) status = look_after(&v);
    if (status != HDR_OK) hdr_log(HDR_FATAL, "%s", hdr_error_text());
    hdr_node_free(v.ros, 1.0); /* after this no callback runs */
    hdr_params_free(params);
    canvas_free(v.on);
    heard_clear(&v.said);
    return refused ? EXIT_REFUSED : status == HDR_OK ? 0 : EXIT_NO_MEMORY;
}
