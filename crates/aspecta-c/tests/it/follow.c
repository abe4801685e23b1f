/* A controller as C programmers write one. Prints what the test reads; returns 0 if all went well. */
#include "aspecta.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CHECK(condition)                                                        \
    do {                                                                        \
        if (!(condition)) {                                                     \
            fprintf(stderr, "line %d: not true: %s\n", __LINE__, #condition);   \
            exit(1);                                                            \
        }                                                                       \
    } while (0)

static const double PI = 3.14159265358979323846;

#ifdef COUNT_ALLOCATIONS
/* With -Wl,--wrap: every allocation of the program and of the library passes here. */
static size_t allocations = 0;
void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t size);
int __real_posix_memalign(void **to, size_t alignment, size_t size);
void *__wrap_malloc(size_t size) { allocations++; return __real_malloc(size); }
void *__wrap_calloc(size_t count, size_t size) { allocations++; return __real_calloc(count, size); }
void *__wrap_realloc(void *old, size_t size) { allocations++; return __real_realloc(old, size); }
int __wrap_posix_memalign(void **to, size_t alignment, size_t size) {
    allocations++;
    return __real_posix_memalign(to, alignment, size);
}
#endif

static void layout(void) {
    printf("size %zu\n", sizeof(aspecta_report));
#define FIELD(name) printf("%s %zu\n", #name, offsetof(aspecta_report, name))
    FIELD(proved);
    FIELD(singular_at);
    FIELD(distance);
    FIELD(length_error);
    FIELD(angle_error);
    FIELD(negative_legs);
    FIELD(stretches);
    FIELD(same_aspect);
    FIELD(within_limits);
    FIELD(leg);
    printf("OK %d\nPARALLEL %d\nSERIAL %d\nTOO_LONG %d\nBAD_INPUT %d\nNULL %d\n", ASPECTA_OK, ASPECTA_PARALLEL,
           ASPECTA_SERIAL, ASPECTA_TOO_LONG, ASPECTA_BAD_INPUT, ASPECTA_NULL);
}

/* Round a circle: poses to joints to poses. */
static void *round_a_circle(void *unused) {
    (void)unused;
    double start[2] = {5.0, 7.0}, joints[2];
    char message[300];
    aspecta_inverse *inverse = aspecta_inverse_start("five-bar", start, 2, "++", message, sizeof message);
    CHECK(inverse != NULL);
    CHECK(aspecta_inverse_last(inverse, NULL, joints) == ASPECTA_OK);
    aspecta_follower *direct = aspecta_start("five-bar", start, joints, 2, message, sizeof message);
    CHECK(direct != NULL && aspecta_dof(direct) == 2);
#ifdef COUNT_ALLOCATIONS
    size_t before = allocations;
#endif
    for (int i = 0; i <= 4000; i++) {
        double angle = 2.0 * PI * i / 4000.0, back[2];
        double pose[2] = {4.0 + cos(angle), 7.0 + sin(angle)};
        aspecta_report report;
        CHECK(aspecta_inverse_step(inverse, pose, joints, &report) == ASPECTA_OK);
        CHECK(report.same_aspect == 1 && report.within_limits == 1 && report.negative_legs == 0);
        CHECK(aspecta_step(direct, joints, back, &report) == ASPECTA_OK);
        CHECK(fabs(back[0] - pose[0]) < 1e-12 && fabs(back[1] - pose[1]) < 1e-12);
        CHECK(report.proved == 1.0 && report.same_aspect == 1 && report.length_error < 1e-12);
    }
    /* A refused step: rods in line on the way. */
    double towards[2] = {joints[0], joints[1]}, pose[2], before_it[2], after_it[2];
    aspecta_report report;
    int status = ASPECTA_OK;
    for (int i = 0; i < 200 && status == ASPECTA_OK; i++) {
        towards[0] += 0.01;
        towards[1] -= 0.01;
        CHECK(aspecta_last(direct, before_it, NULL) == ASPECTA_OK);
        status = aspecta_step(direct, towards, pose, &report);
    }
    CHECK(status == ASPECTA_PARALLEL && report.proved < report.singular_at && report.distance < 0.1);
    CHECK(aspecta_last(direct, after_it, NULL) == ASPECTA_OK);
    CHECK(before_it[0] == after_it[0] && pose[0] == before_it[0]);
    double unreachable[2] = {50.0, 7.0};
    CHECK(aspecta_inverse_step(inverse, unreachable, joints, &report) == ASPECTA_SERIAL);
    CHECK(report.leg == 1 || report.leg == 2);
    double bad[2] = {NAN, 0.0};
    CHECK(aspecta_step(direct, bad, pose, NULL) == ASPECTA_BAD_INPUT);
#ifdef COUNT_ALLOCATIONS
    printf("allocations %zu\n", allocations - before);
#endif
    aspecta_inverse_free(inverse);
    aspecta_free(direct);
    return NULL;
}

static void complaints(void) {
    double pose[3] = {4.0, 7.0, 0.0}, q[3] = {0.5, 3.0, 0.0};
    char message[400], small[8];
    CHECK(aspecta_start("five-barr", pose, q, 2, message, sizeof message) == NULL);
    CHECK(strstr(message, "no robot `five-barr` in the catalogue, which has five-bar,") != NULL);
    CHECK(aspecta_start("five-barr", pose, q, 2, small, sizeof small) == NULL && strcmp(small, "no robo") == 0);
    CHECK(aspecta_start("five-barr", pose, q, 2, NULL, 0) == NULL);
    CHECK(aspecta_start("five-bar", pose, q, 3, message, sizeof message) == NULL);
    CHECK(strstr(message, "2 pose coordinates (x, y), not 3") != NULL);
    CHECK(aspecta_start("five-bar", pose, q, 2, message, sizeof message) == NULL);
    CHECK(strstr(message, "no solution for this joint vector") != NULL);
    CHECK(aspecta_start(NULL, pose, q, 2, message, sizeof message) == NULL && strstr(message, "robot is NULL"));
    CHECK(aspecta_start("five-bar", NULL, q, 2, message, sizeof message) == NULL && strstr(message, "pose is NULL"));
    CHECK(aspecta_inverse_start("five-bar", pose, 2, "+", message, sizeof message) == NULL);
    CHECK(aspecta_inverse_start("five-bar", pose, 2, "up", message, sizeof message) == NULL);
    CHECK(strstr(message, "`up` is not a working mode") != NULL);
    CHECK(aspecta_start("name = 3\n", pose, q, 2, message, sizeof message) == NULL && strlen(message) > 10);
    CHECK(aspecta_step(NULL, q, pose, NULL) == ASPECTA_NULL && aspecta_dof(NULL) == 0);
    CHECK(aspecta_inverse_step(NULL, pose, q, NULL) == ASPECTA_NULL);
    CHECK(aspecta_last(NULL, pose, q) == ASPECTA_NULL && aspecta_inverse_last(NULL, pose, q) == ASPECTA_NULL);
    aspecta_free(NULL);
    aspecta_inverse_free(NULL);
}

/* A robot file as text. */
static void own_robot(void) {
    const char *text = "name = \"mine\"\nplatform = \"plane-point\"\n"
                       "[[legs]]\nanchor = [0, 0]\nactuator = { kind = \"strut\" }\n"
                       "[[legs]]\nanchor = [6, 0]\nactuator = { kind = \"strut\" }\n";
    double pose[2] = {3.0, 4.0}, q[2] = {5.0, 5.0}, longer[2] = {5.001, 5.0};
    char message[300] = "";
    aspecta_follower *follower = aspecta_start(text, pose, q, 2, message, sizeof message);
    if (follower == NULL) fprintf(stderr, "%s\n", message);
    CHECK(follower != NULL);
    aspecta_report report;
    CHECK(aspecta_step(follower, longer, pose, &report) == ASPECTA_OK && report.negative_legs == 3);
    CHECK(fabs(hypot(pose[0], pose[1]) - 5.001) < 1e-12 && fabs(hypot(pose[0] - 6.0, pose[1]) - 5.0) < 1e-12);
    aspecta_free(follower);
}

int main(void) {
    layout();
    round_a_circle(NULL);
    complaints();
    own_robot();
#ifndef COUNT_ALLOCATIONS
    pthread_t threads[4];
    for (int i = 0; i < 4; i++) CHECK(pthread_create(&threads[i], NULL, round_a_circle, NULL) == 0);
    for (int i = 0; i < 4; i++) CHECK(pthread_join(threads[i], NULL) == 0);
#endif
    puts("done");
    return 0;
}
