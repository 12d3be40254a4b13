/* Both sessions of the C interface against each other in memory: registration, a plan and its Ack, a report and its answer. */
#include "Check.h"

#include <stdlib.h>

static const char PLAN[] =
    "{\"planId\":\"P-1\",\"lotId\":\"L\",\"priority\":10,\"steps\":[{\"stepNo\":1,\"action\":\"CassetteLoad\","
    "\"position\":\"A01.CP01\",\"carrierIds\":[\"C\"],\"jobs\":[{\"jobId\":\"J\",\"from\":\"A01.CP01\","
    "\"to\":\"AMR.CP01\"}]}]}";
static const char REPORT[] =
    "{\"command\":\"PlanReport\",\"transactionId\":\"report-1\",\"payload\":{\"planId\":\"P-1\","
    "\"status\":\"InProgress\"}}";
static const char LOCAL_REPORT[] =
    "{\"command\":\"PlanReport\",\"transactionId\":\"report-2\",\"timestamp\":\"2020-01-01T12:00:00\","
    "\"payload\":{\"planId\":\"P-1\",\"status\":\"Completed\"}}";

#define CONNECTION 1u
#define EVENTS 14
#define TIMERS 6

/* The two sessions, what lies between them, and what happened last. */
typedef struct line
{
    acs_mcs* mcs;
    acs_acs* acs;
    acs_codec* codec;
    int64_t now;
    int text_lost; /* The next text to the ACS is lost. */
    unsigned mcs_events[EVENTS];
    unsigned acs_events[EVENTS];
    int64_t acs_delays[TIMERS]; /* -1: not running */
    uint64_t token;
    int32_t result;
    char transaction_id[64];
    char text[1024];
} line;

static void copy(char* target, size_t size, acs_text text)
{
    CHECK(text.length < size);
    memcpy(target, text.data, text.length + 1);
}

static void keep_event(line* l, const acs_action* action)
{
    if (action->event == ACS_EVENT_REQUEST_RECEIVED || action->event == ACS_EVENT_ACK_RECEIVED
        || action->event == ACS_EVENT_ACKED)
    {
        l->token = action->token;
        l->result = action->result;
        copy(l->transaction_id, sizeof l->transaction_id, action->transaction_id);
        copy(l->text, sizeof l->text, action->text);
    }
}

static void carry_out_for_acs(line* l, const acs_action* action)
{
    switch (action->type)
    {
        case ACS_ACTION_CONNECT:
            CHECK(acs_mcs_connected(l->mcs, CONNECTION, l->now, l->now) == ACS_OK);
            CHECK(acs_acs_connected(l->acs, l->now, l->now) == ACS_OK);
            break;
        case ACS_ACTION_SEND_TEXT:
            CHECK(
                acs_mcs_received(l->mcs, CONNECTION, action->text.data, action->text.length, l->now, l->now) == ACS_OK);
            break;
        case ACS_ACTION_CLOSE:
            CHECK(
                acs_mcs_closed(l->mcs, CONNECTION, action->message.data, action->message.length, l->now, l->now)
                == ACS_OK);
            CHECK(acs_acs_closed(l->acs, "", 0, l->now, l->now) == ACS_OK);
            break;
        case ACS_ACTION_START_TIMER:
            l->acs_delays[action->timer] = action->delay_ms;
            break;
        case ACS_ACTION_CANCEL_TIMER:
            l->acs_delays[action->timer] = -1;
            break;
        case ACS_ACTION_EVENT:
            ++l->acs_events[action->event];
            keep_event(l, action);
            break;
        default:
            CHECK(0);
            break;
    }
}

static void carry_out_for_mcs(line* l, const acs_action* action)
{
    if (action->type == ACS_ACTION_SEND_TEXT)
    {
        CHECK(action->connection == CONNECTION);
        if (l->text_lost)
        {
            l->text_lost = 0;
            return;
        }
        CHECK(acs_acs_received(l->acs, action->text.data, action->text.length, l->now, l->now) == ACS_OK);
    }
    else if (action->type == ACS_ACTION_EVENT)
    {
        ++l->mcs_events[action->event];
        keep_event(l, action);
    }
}

/* Until no action waits on either side. */
static void settle(line* l)
{
    acs_action action;
    int any = 1;
    memset(&action, 0, sizeof action);
    action.struct_size = sizeof action;
    while (any)
    {
        any = 0;
        CHECK(acs_acs_next_action(l->acs, &action) == ACS_OK);
        if (action.type != ACS_ACTION_NONE)
        {
            any = 1;
            carry_out_for_acs(l, &action);
        }
        CHECK(acs_mcs_next_action(l->mcs, &action) == ACS_OK);
        if (action.type != ACS_ACTION_NONE)
        {
            any = 1;
            carry_out_for_mcs(l, &action);
        }
    }
}

static uint64_t count_up(void* context)
{
    return ++*(uint64_t*)context;
}

static line make_line(uint64_t* counter)
{
    line l;
    acs_mcs_options mcs_options;
    acs_acs_options acs_options;
    memset(&l, 0, sizeof l);
    l.now = 1000;
    CHECK(acs_mcs_options_init(&mcs_options, sizeof mcs_options) == ACS_OK);
    CHECK(acs_acs_options_init(&acs_options, sizeof acs_options) == ACS_OK);
    mcs_options.answered_commands.data = "PlanReport JobReport";
    mcs_options.answered_commands.length = strlen(mcs_options.answered_commands.data);
    acs_options.position_interval_ms = 0;
    acs_options.random = count_up;
    acs_options.random_context = counter;
    CHECK(acs_mcs_create(ACS_C_ABI_VERSION, &mcs_options, &l.mcs) == ACS_OK);
    CHECK(acs_acs_create(ACS_C_ABI_VERSION, &acs_options, &l.acs) == ACS_OK);
    CHECK(acs_codec_create(ACS_C_ABI_VERSION, NULL, &l.codec) == ACS_OK);
    return l;
}

static void end_line(line* l)
{
    acs_mcs_destroy(l->mcs);
    acs_acs_destroy(l->acs);
    acs_codec_destroy(l->codec);
}

static acs_message make_message(void)
{
    acs_message message;
    memset(&message, 0, sizeof message);
    message.struct_size = sizeof message;
    return message;
}

static void begin(line* l)
{
    CHECK(acs_acs_start(l->acs, l->now, l->now) == ACS_OK);
    settle(l);
    CHECK(l->acs_events[ACS_EVENT_REGISTERED] == 1 && l->mcs_events[ACS_EVENT_REGISTERED] == 1);
    CHECK(acs_acs_replay_done(l->acs, l->now, l->now) == ACS_OK);
    settle(l);
}

static int32_t send_plan(line* l, acs_message* message)
{
    CHECK(acs_codec_make_request(l->codec, "ExecutionPlan", 13, PLAN, sizeof PLAN - 1, l->now, message) == ACS_OK);
    return acs_mcs_send(l->mcs, message->text.data, message->text.length, l->now, l->now, NULL);
}

static void test_plan_and_report(void)
{
    uint64_t counter = 0;
    line l = make_line(&counter);
    acs_message plan = make_message();
    acs_message made = make_message();
    acs_mcs_state state;
    memset(&state, 0, sizeof state);
    state.struct_size = sizeof state;
    CHECK(send_plan(&l, &plan) == ACS_ERROR_NOT_READY);
    CHECK(acs_acs_send(l.acs, REPORT, sizeof REPORT - 1, l.now, l.now, NULL) == ACS_ERROR_NOT_READY);

    begin(&l);
    CHECK(counter > 0);
    CHECK(acs_mcs_get_state(l.mcs, &state) == ACS_OK);
    CHECK(
        state.registered == 1 && state.takes_plans == 1 && state.connection == CONNECTION
        && state.waiting_actions == 0);

    CHECK(send_plan(&l, &plan) == ACS_OK);
    settle(&l);
    CHECK(l.acs_events[ACS_EVENT_REQUEST_RECEIVED] == 1);
    CHECK(strcmp(l.text, plan.text.data) == 0 && strcmp(l.transaction_id, plan.transaction_id.data) == 0);
    CHECK(
        acs_codec_make_ack(
            l.codec,
            "ExecutionPlan",
            13,
            l.transaction_id,
            strlen(l.transaction_id),
            ACS_RESULT_FAIL,
            "full",
            4,
            "{\"planId\":\"P-1\"}",
            16,
            l.now,
            &made)
        == ACS_OK);
    CHECK(acs_acs_answer(l.acs, made.text.data, made.text.length, l.now, l.now, NULL) == ACS_OK);
    settle(&l);
    CHECK(l.mcs_events[ACS_EVENT_ACK_RECEIVED] == 1 && l.result == ACS_RESULT_FAIL);
    CHECK(strstr(l.text, "\"message\":\"full\",\"payload\":{\"planId\":\"P-1\"}") != NULL);

    CHECK(acs_acs_send(l.acs, REPORT, sizeof REPORT - 1, l.now, l.now, &made) == ACS_OK);
    CHECK(has(made.text, "\"timestamp\":\"1970-01-01T00:00:01.000+00:00\""));
    settle(&l);
    CHECK(l.mcs_events[ACS_EVENT_REQUEST_RECEIVED] == 1 && l.token != 0 && l.acs_events[ACS_EVENT_ACKED] == 0);
    l.text_lost = 1;
    CHECK(acs_mcs_answer(l.mcs, l.token, ACS_RESULT_SUCCESS, "stored", 6, l.now, l.now) == ACS_OK);
    CHECK(acs_mcs_answer(l.mcs, l.token, ACS_RESULT_SUCCESS, "", 0, l.now, l.now) == ACS_ERROR_NOT_WAITING);
    settle(&l);
    CHECK(l.acs_events[ACS_EVENT_ACKED] == 0 && l.acs_delays[ACS_TIMER_ACK] == 5000);
    l.now += l.acs_delays[ACS_TIMER_ACK];
    CHECK(acs_acs_timer_elapsed(l.acs, ACS_TIMER_ACK, l.now, l.now) == ACS_OK);
    settle(&l);
    CHECK(l.acs_events[ACS_EVENT_ACKED] == 1 && strcmp(l.transaction_id, "report-1") == 0);
    CHECK(l.mcs_events[ACS_EVENT_REQUEST_RECEIVED] == 1);

    /* A time without an offset has the present one of the site. */
    CHECK(acs_acs_set_site_offset(l.acs, 540) == ACS_OK);
    CHECK(acs_acs_send(l.acs, LOCAL_REPORT, sizeof LOCAL_REPORT - 1, l.now, l.now, &made) == ACS_OK);
    CHECK(has(made.text, "\"timestamp\":\"2020-01-01T12:00:00.000+09:00\""));
    end_line(&l);
}

static void test_lost_link_and_stop(void)
{
    uint64_t counter = 0;
    line l = make_line(&counter);
    acs_message plan = make_message();
    begin(&l);
    CHECK(send_plan(&l, &plan) == ACS_OK);
    settle(&l);
    CHECK(acs_acs_stop(l.acs, l.now, l.now) == ACS_OK);
    settle(&l);
    CHECK(l.acs_events[ACS_EVENT_STOPPED] == 1);
    CHECK(l.mcs_events[ACS_EVENT_LINK_LOST] == 1 && l.mcs_events[ACS_EVENT_REQUEST_UNANSWERED] == 1);

    /* Both are closed now: nothing is sent, and late events are ignored. */
    CHECK(send_plan(&l, &plan) == ACS_ERROR_NOT_READY);
    CHECK(acs_acs_send(l.acs, REPORT, sizeof REPORT - 1, l.now, l.now, NULL) == ACS_ERROR_NOT_READY);
    CHECK(acs_acs_connected(l.acs, l.now, l.now) == ACS_OK);
    CHECK(acs_acs_received(l.acs, REPORT, sizeof REPORT - 1, l.now, l.now) == ACS_OK);
    CHECK(acs_mcs_received(l.mcs, CONNECTION, REPORT, sizeof REPORT - 1, l.now, l.now) == ACS_OK);
    CHECK(acs_mcs_received(l.mcs, 77, REPORT, sizeof REPORT - 1, l.now, l.now) == ACS_OK);
    CHECK(acs_mcs_closed(l.mcs, CONNECTION, "", 0, l.now, l.now) == ACS_OK);
    CHECK(acs_acs_timer_elapsed(l.acs, ACS_TIMER_ANSWER, l.now, l.now) == ACS_OK);
    CHECK(acs_mcs_timer_elapsed(l.mcs, ACS_TIMER_SHUTDOWN, l.now, l.now) == ACS_OK);
    CHECK(acs_mcs_connected(l.mcs, CONNECTION, l.now, l.now) == ACS_ERROR_ARGUMENT);
    CHECK(acs_mcs_connected(l.mcs, CONNECTION + 1, l.now, l.now) == ACS_OK);
    end_line(&l);
}

static void test_texts_of_the_peer(void)
{
    uint64_t counter = 0;
    line l = make_line(&counter);
    const size_t huge = 5u * 1024u * 1024u;
    char* text = malloc(huge);
    begin(&l);
    CHECK(acs_mcs_received(l.mcs, CONNECTION, "\xff\xfe", 2, l.now, l.now) == ACS_OK);
    CHECK(acs_acs_received(l.acs, REPORT, sizeof REPORT / 2, l.now, l.now) == ACS_OK);
    if (text != NULL)
    {
        memset(text, '{', huge);
        CHECK(acs_mcs_received(l.mcs, CONNECTION, text, huge, l.now, l.now) == ACS_OK);
    }
    settle(&l);
    CHECK(l.mcs_events[ACS_EVENT_NOTED] == 2 && l.acs_events[ACS_EVENT_NOTED] == 1);
    free(text);
    end_line(&l);
}

static void test_invalid_sends(void)
{
    uint64_t counter = 0;
    line l = make_line(&counter);
    acs_message message = make_message();
    const char bad[] = "{\"command\":\"CancelPlan\",\"transactionId\":\"t\",\"payload\":{}}";
    const char registration[] = "{\"command\":\"Registration\",\"transactionId\":\"t\",\"payload\":{}}";
    const char ack[] = "{\"command\":\"PlanReportAck\",\"transactionId\":\"t\",\"result\":\"Success\",\"payload\":{}}";
    begin(&l);
    CHECK(acs_mcs_send(l.mcs, bad, sizeof bad - 1, l.now, l.now, &message) == ACS_ERROR_MESSAGE);
    CHECK_TEXT(message.error_path, "payload.planId");
    CHECK(acs_mcs_send(l.mcs, REPORT, sizeof REPORT - 1, l.now, l.now, &message) == ACS_ERROR_DIRECTION);
    CHECK(acs_mcs_send(l.mcs, ack, sizeof ack - 1, l.now, l.now, NULL) == ACS_ERROR_DIRECTION);
    CHECK(acs_mcs_send(l.mcs, "", 0, l.now, l.now, NULL) == ACS_ERROR_MESSAGE);
    CHECK(acs_acs_send(l.acs, registration, sizeof registration - 1, l.now, l.now, NULL) == ACS_ERROR_DIRECTION);
    CHECK(acs_acs_send(l.acs, ack, sizeof ack - 1, l.now, l.now, NULL) == ACS_ERROR_DIRECTION);
    CHECK(acs_acs_answer(l.acs, ack, sizeof ack - 1, l.now, l.now, NULL) == ACS_ERROR_DIRECTION);
    CHECK(acs_acs_answer(l.acs, REPORT, sizeof REPORT - 1, l.now, l.now, NULL) == ACS_ERROR_DIRECTION);
    CHECK(acs_acs_answer(l.acs, bad, 5, l.now, l.now, &message) == ACS_ERROR_MESSAGE);
    settle(&l);
    CHECK(l.acs_events[ACS_EVENT_REQUEST_RECEIVED] == 0 && l.mcs_events[ACS_EVENT_REQUEST_RECEIVED] == 0);
    end_line(&l);
}

static void test_statuses(void)
{
    uint64_t counter = 0;
    line l = make_line(&counter);
    const char tsc[] = "{\"command\":\"TscStateUpdate\",\"transactionId\":\"t\",\"payload\":{\"state\":\"Auto\"}}";
    CHECK(acs_acs_send(l.acs, tsc, sizeof tsc - 1, l.now, l.now, NULL) == ACS_OK);
    begin(&l);
    CHECK(l.mcs_events[ACS_EVENT_REQUEST_RECEIVED] == 1 && l.token == 0);
    CHECK(strstr(l.text, "\"command\":\"TscStateUpdate\"") != NULL);
    end_line(&l);
}

static void test_options(void)
{
    acs_mcs* mcs = NULL;
    acs_acs* acs = NULL;
    acs_mcs_options mcs_options;
    acs_acs_options acs_options;
    const char* wrong[] = {"Dance", "CancelPlan", "RobotPositionUpdate", "PlanReport  StepReport", "\xff"};
    size_t i = 0;
    CHECK(acs_mcs_options_init(NULL, sizeof mcs_options) == ACS_ERROR_ARGUMENT);
    CHECK(acs_acs_options_init(NULL, sizeof acs_options) == ACS_ERROR_ARGUMENT);
    CHECK(acs_mcs_options_init(&mcs_options, sizeof mcs_options + 8) == ACS_ERROR_VERSION);
    CHECK(acs_acs_options_init(&acs_options, sizeof acs_options + 8) == ACS_ERROR_VERSION);
    CHECK(acs_mcs_options_init(&mcs_options, sizeof mcs_options) == ACS_OK);
    CHECK(acs_acs_options_init(&acs_options, sizeof acs_options) == ACS_OK);
    CHECK(mcs_options.answer_timeout_ms == 10000 && acs_options.window == 16 && acs_options.reconnect_max_ms == 10000);

    CHECK(acs_mcs_create(ACS_C_ABI_VERSION + 1, &mcs_options, &mcs) == ACS_ERROR_VERSION && mcs == NULL);
    CHECK(acs_acs_create(ACS_C_ABI_VERSION - 1, &acs_options, &acs) == ACS_ERROR_VERSION && acs == NULL);
    CHECK(acs_mcs_create(ACS_C_ABI_VERSION, &mcs_options, NULL) == ACS_ERROR_ARGUMENT);
    CHECK(acs_acs_create(ACS_C_ABI_VERSION, &acs_options, NULL) == ACS_ERROR_ARGUMENT);
    for (i = 0; i < sizeof wrong / sizeof wrong[0]; ++i)
    {
        mcs_options.answered_commands.data = wrong[i];
        mcs_options.answered_commands.length = strlen(wrong[i]);
        CHECK(acs_mcs_create(ACS_C_ABI_VERSION, &mcs_options, &mcs) != ACS_OK && mcs == NULL);
    }
    mcs_options.answered_commands.data = NULL;
    mcs_options.codec.struct_size = 0;
    CHECK(acs_mcs_create(ACS_C_ABI_VERSION, &mcs_options, &mcs) == ACS_ERROR_VERSION);
    acs_options.window = 0;
    CHECK(acs_acs_create(ACS_C_ABI_VERSION, &acs_options, &acs) == ACS_ERROR_ARGUMENT);
    acs_options.window = 1;
    acs_options.reserved[2] = 1;
    CHECK(acs_acs_create(ACS_C_ABI_VERSION, &acs_options, &acs) == ACS_ERROR_ARGUMENT);
    acs_options.struct_size = 8;
    CHECK(acs_acs_create(ACS_C_ABI_VERSION, &acs_options, &acs) == ACS_ERROR_VERSION && acs == NULL);
    acs_mcs_destroy(NULL);
    acs_acs_destroy(NULL);
}

static void test_null_arguments(void)
{
    uint64_t counter = 0;
    line l = make_line(&counter);
    acs_action action;
    acs_mcs_state mcs_state;
    acs_acs_state acs_state;
    memset(&action, 0, sizeof action);
    action.struct_size = sizeof action;
    mcs_state.struct_size = sizeof mcs_state;
    acs_state.struct_size = sizeof acs_state;
    CHECK(acs_mcs_connected(NULL, 1, 0, 0) == ACS_ERROR_ARGUMENT);
    CHECK(acs_mcs_received(NULL, 1, "", 0, 0, 0) == ACS_ERROR_ARGUMENT);
    CHECK(acs_mcs_received(l.mcs, 1, NULL, 3, 0, 0) == ACS_ERROR_ARGUMENT);
    CHECK(acs_mcs_closed(NULL, 1, "", 0, 0, 0) == ACS_ERROR_ARGUMENT);
    CHECK(acs_mcs_closed(l.mcs, 1, NULL, 3, 0, 0) == ACS_ERROR_ARGUMENT);
    CHECK(acs_mcs_timer_elapsed(NULL, 0, 0, 0) == ACS_ERROR_ARGUMENT);
    CHECK(acs_mcs_send(NULL, "", 0, 0, 0, NULL) == ACS_ERROR_ARGUMENT);
    CHECK(acs_mcs_send(l.mcs, NULL, 3, 0, 0, NULL) == ACS_ERROR_ARGUMENT);
    CHECK(acs_mcs_answer(NULL, 1, 0, "", 0, 0, 0) == ACS_ERROR_ARGUMENT);
    CHECK(acs_mcs_answer(l.mcs, 1, 0, NULL, 3, 0, 0) == ACS_ERROR_ARGUMENT);
    CHECK(acs_mcs_next_action(NULL, &action) == ACS_ERROR_ARGUMENT);
    CHECK(acs_mcs_next_action(l.mcs, NULL) == ACS_ERROR_ARGUMENT);
    CHECK(acs_mcs_get_state(NULL, &mcs_state) == ACS_ERROR_ARGUMENT);
    CHECK(acs_mcs_get_state(l.mcs, NULL) == ACS_ERROR_ARGUMENT);
    CHECK(acs_mcs_set_site_offset(NULL, 0) == ACS_ERROR_ARGUMENT);

    CHECK(acs_acs_start(NULL, 0, 0) == ACS_ERROR_ARGUMENT);
    CHECK(acs_acs_stop(NULL, 0, 0) == ACS_ERROR_ARGUMENT);
    CHECK(acs_acs_connected(NULL, 0, 0) == ACS_ERROR_ARGUMENT);
    CHECK(acs_acs_received(NULL, "", 0, 0, 0) == ACS_ERROR_ARGUMENT);
    CHECK(acs_acs_received(l.acs, NULL, 3, 0, 0) == ACS_ERROR_ARGUMENT);
    CHECK(acs_acs_closed(NULL, "", 0, 0, 0) == ACS_ERROR_ARGUMENT);
    CHECK(acs_acs_closed(l.acs, NULL, 3, 0, 0) == ACS_ERROR_ARGUMENT);
    CHECK(acs_acs_timer_elapsed(NULL, 0, 0, 0) == ACS_ERROR_ARGUMENT);
    CHECK(acs_acs_send(NULL, "", 0, 0, 0, NULL) == ACS_ERROR_ARGUMENT);
    CHECK(acs_acs_send(l.acs, NULL, 3, 0, 0, NULL) == ACS_ERROR_ARGUMENT);
    CHECK(acs_acs_replay_done(NULL, 0, 0) == ACS_ERROR_ARGUMENT);
    CHECK(acs_acs_answer(NULL, "", 0, 0, 0, NULL) == ACS_ERROR_ARGUMENT);
    CHECK(acs_acs_answer(l.acs, NULL, 3, 0, 0, NULL) == ACS_ERROR_ARGUMENT);
    CHECK(acs_acs_next_action(NULL, &action) == ACS_ERROR_ARGUMENT);
    CHECK(acs_acs_next_action(l.acs, NULL) == ACS_ERROR_ARGUMENT);
    CHECK(acs_acs_get_state(NULL, &acs_state) == ACS_ERROR_ARGUMENT);
    CHECK(acs_acs_get_state(l.acs, NULL) == ACS_ERROR_ARGUMENT);
    CHECK(acs_acs_set_site_offset(NULL, 0) == ACS_ERROR_ARGUMENT);
    end_line(&l);
}

static void test_other_arguments(void)
{
    uint64_t counter = 0;
    line l = make_line(&counter);
    acs_message message = make_message();
    acs_action action;
    acs_acs_state state;
    int32_t result = ACS_OK;
    unsigned texts = 0;
    memset(&action, 0, sizeof action);
    CHECK(acs_mcs_next_action(l.mcs, &action) == ACS_ERROR_VERSION);
    CHECK(acs_acs_next_action(l.acs, &action) == ACS_ERROR_VERSION);
    state.struct_size = 1;
    CHECK(acs_acs_get_state(l.acs, &state) == ACS_ERROR_VERSION);
    message.struct_size = 1;
    CHECK(acs_mcs_send(l.mcs, REPORT, sizeof REPORT - 1, 0, 0, &message) == ACS_ERROR_VERSION);

    CHECK(acs_acs_start(l.acs, -1, 0) == ACS_ERROR_ARGUMENT);
    CHECK(acs_acs_start(l.acs, 0, ACS_TIME_MAX_MS + 1) == ACS_ERROR_ARGUMENT);
    CHECK(acs_acs_start(l.acs, ACS_TIME_MAX_MS, ACS_TIME_MAX_MS) == ACS_OK);
    CHECK(acs_acs_connected(l.acs, 0, 0) == ACS_OK); /* a steady time that goes back counts as the latest one */
    CHECK(acs_acs_closed(l.acs, "\xc3(", 2, 0, 0) == ACS_ERROR_UTF8);
    CHECK(acs_mcs_answer(l.mcs, 0, ACS_RESULT_SUCCESS, "\xff", 1, 0, 0) == ACS_ERROR_UTF8);
    CHECK(acs_mcs_answer(l.mcs, 0, 7, "", 0, 0, 0) == ACS_ERROR_ARGUMENT);
    CHECK(acs_mcs_answer(l.mcs, 0, ACS_RESULT_FAIL, "", 0, 0, 0) == ACS_ERROR_NOT_WAITING);
    CHECK(acs_mcs_timer_elapsed(l.mcs, TIMERS, 0, 0) == ACS_ERROR_ARGUMENT);
    CHECK(acs_acs_timer_elapsed(l.acs, -1, 0, 0) == ACS_ERROR_ARGUMENT);
    CHECK(acs_mcs_connected(l.mcs, 0, 0, 0) == ACS_ERROR_ARGUMENT);
    CHECK(acs_mcs_set_site_offset(l.mcs, 1440) == ACS_ERROR_ARGUMENT);
    CHECK(acs_mcs_set_site_offset(l.mcs, 540) == ACS_OK);
    CHECK(acs_acs_set_site_offset(l.acs, -1440) == ACS_ERROR_ARGUMENT);

    /* A caller that takes no action. */
    CHECK(acs_mcs_connected(l.mcs, CONNECTION, 0, 0) == ACS_OK);
    while (result == ACS_OK && texts < 2 * ACS_MAX_ACTIONS)
    {
        result = acs_mcs_received(l.mcs, CONNECTION, "x", 1, 0, 0);
        ++texts;
    }
    CHECK(result == ACS_ERROR_QUEUE_FULL && texts == ACS_MAX_ACTIONS);
    action.struct_size = sizeof action;
    CHECK(acs_mcs_next_action(l.mcs, &action) == ACS_OK && action.type == ACS_ACTION_START_TIMER);
    CHECK(acs_mcs_received(l.mcs, CONNECTION, "x", 1, 0, 0) == ACS_OK);
    end_line(&l);
}

int main(void)
{
    test_plan_and_report();
    test_lost_link_and_stop();
    test_texts_of_the_peer();
    test_invalid_sends();
    test_statuses();
    test_options();
    test_null_arguments();
    test_other_arguments();
    return report();
}
