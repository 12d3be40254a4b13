/* The MCS-ACS protocol for C and for languages that call C: codec, MCS side and ACS side. C99 and C++.
 *
 * The library opens no socket, starts no thread and reads no clock. The caller reports what happens (connected, received, closed,
 * timer elapsed) together with the time, and carries out the actions that it takes from the queue of the handle.
 *
 * Rules of all functions
 * - Result: ACS_OK or an ACS_ERROR_ constant. No C++ exception leaves the library. After an error nothing has changed, except after
 *   ACS_ERROR_MEMORY and ACS_ERROR_INTERNAL.
 * - Null: a null pointer gives ACS_ERROR_ARGUMENT unless the function allows it.
 * - Threads: a handle is used by one thread at a time. Different handles may be used by different threads at once.
 * - Ownership: handles belong to the caller, who ends each one with its destroy function. Texts that a function returns belong to
 *   the handle and must not be freed. Texts that the caller passes are copied where they are kept.
 * - Texts: UTF-8, a pointer and a length in bytes. A returned text is never null and ends with a zero byte that its length does not
 *   count; it may contain zero bytes.
 * - Times: steady_ms counts milliseconds from any start and never goes back; an earlier value counts as the latest one. wall_ms
 *   counts milliseconds since 1970-01-01 UTC. Both: 0 to ACS_TIME_MAX_MS.
 * - Structures: the caller sets struct_size to sizeof before each call. A wrong declaration in another language is so detected.
 */
#ifndef ACS_C_ACS_PROTOCOL_H
#define ACS_C_ACS_PROTOCOL_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define ACS_C_EXPORT __attribute__((visibility("default")))
#else
#define ACS_C_EXPORT
#endif

#ifdef __cplusplus
extern "C"
{
#endif

/* The version of this interface. It changes when a structure, a constant or a function changes; so does the soversion. */
#define ACS_C_ABI_VERSION 1u

/* ---- Results ------------------------------------------------------------------------------------------------------------- */

#define ACS_OK 0              /* The call has done what it is for. */
#define ACS_ERROR_ARGUMENT 1  /* A null pointer, or a number out of range. */
#define ACS_ERROR_VERSION 2   /* Another ABI version or struct_size than that of the library. */
#define ACS_ERROR_MEMORY 3    /* Out of memory. A session cannot be used afterwards. */
#define ACS_ERROR_INTERNAL 4  /* A defect of the library. A session cannot be used afterwards. */
#define ACS_ERROR_BROKEN 5    /* An earlier call of this session ended with one of the two errors above. */
#define ACS_ERROR_MESSAGE 6   /* Not a valid message; acs_message has the reason and the JSON path. */
#define ACS_ERROR_DIRECTION 7 /* A valid message that this function does not send. */
#define ACS_ERROR_NOT_READY                                                                                            \
8 /* Not registered, the window is full, too many requests are pending, or plans are withheld. */
#define ACS_ERROR_NOT_WAITING 9 /* The request waits for no answer. */
#define ACS_ERROR_QUEUE_FULL 10 /* ACS_MAX_ACTIONS actions wait: take them first. */
#define ACS_ERROR_UTF8 11       /* A text that is not a message is not valid UTF-8. */

/* ---- Limits -------------------------------------------------------------------------------------------------------------- */

#define ACS_TIME_MAX_MS 8000000000000 /* Of a time: year 2223. */
#define ACS_DURATION_MAX_MS 86400000  /* Of a duration: one day. */
#define ACS_COUNT_MAX 1048576u        /* Of a count in the options. */
#define ACS_SIZE_MAX 268435456u       /* Of a size in bytes in the options: 256 MiB. */
#define ACS_MAX_ACTIONS 65536u        /* Actions that wait in a handle; one call may exceed it. */
#define ACS_MAX_NOTE_BYTES 65536u     /* Of a reason or of the message of an answer. */

/* A text in UTF-8. */
typedef struct acs_text
{
    const char* data; /* Of a returned text: never null, and a zero byte follows it. */
    size_t length;    /* Bytes, without that zero byte. */
} acs_text;

/* Writes ACS_C_ABI_VERSION of the library. */
ACS_C_EXPORT int32_t acs_c_abi_version(uint32_t* version);

/* Writes the version of the SDK, "0.1.0". The text is static. */
ACS_C_EXPORT int32_t acs_c_version(acs_text* version);

/* Writes a short English text for a result, also for an unknown one. The text is static. */
ACS_C_EXPORT int32_t acs_c_describe(int32_t result, acs_text* text);

/* ---- Codec ---------------------------------------------------------------------------------------------------------------- */

/* What is accepted from the other side. A text has at most 250000 values in any case. */
typedef struct acs_codec_options
{
    uint32_t struct_size; /* Set by the caller. */
    int32_t site_offset_minutes; /* UTC offset of the site, also for timestamps without one; -1439 to 1439 (0). */
    uint64_t max_bytes;          /* Of a text; 1 to ACS_SIZE_MAX (4 MiB). */
    uint64_t max_string;         /* Bytes of a string; 1 to ACS_SIZE_MAX (64 KiB). */
    uint32_t max_depth;          /* Of nested objects and arrays; 1 to 1024 (64). */
    uint32_t max_array;          /* Elements of an array; 1 to ACS_COUNT_MAX (10000). */
    uint8_t refuse_unknown_members; /* Booleans: 0 or not 0. (0: they are ignored and counted.) */
    uint8_t accept_legacy_names;    /* RequestAcsStatus for RequestAcsPlans (1). */
    uint8_t accept_lenient_json;    /* Comments and trailing commas (0). */
    uint8_t check_locations;        /* Reject a plan with an invalid location (1). */
    uint32_t reserved;              /* 0 */
} acs_codec_options;

#define ACS_KIND_INVALID 0 /* Not a valid message. */
#define ACS_KIND_REQUEST 1 /* Of the MCS or of the ACS; a report is one too. */
#define ACS_KIND_ACK 2     /* The answer to a request. */

#define ACS_RESULT_SUCCESS 0 /* The request is accepted. */
#define ACS_RESULT_FAIL 1    /* The request is refused; the message of the Ack has the reason. */

/* A message, or why a text is not one. Its texts live until the next call of a function that writes an acs_message with the
 * same handle, or until the handle is destroyed. */
typedef struct acs_message
{
    uint32_t struct_size; /* Set by the caller. */
    int32_t kind;         /* ACS_KIND_ */
    int32_t result;       /* ACS_RESULT_ of an Ack; 0 for a request. */
    uint32_t notes; /* Number of deviations that were tolerated: unknown members, other upper or lower case, ... */
    acs_text command; /* Of the request, without Ack; of an invalid message as sent, as far as it can be read. */
    acs_text transaction_id; /* Empty if it cannot be read. */
    acs_text text; /* The whole message as compact JSON, members in the order of the specification; empty if invalid. */
    acs_text message;        /* Of an Ack, for the operator; may be empty. */
    acs_text error;          /* One sentence; empty for a valid message, like the next three. */
    acs_text error_path;     /* JSON path ("payload.steps[0].action"); empty for the whole text. */
    acs_text error_expected; /* ("an integer from 1 to 100") */
    acs_text error_found;    /* The received value, shortened. */
} acs_message;

/* Handle of a codec. It has no session and no queue of actions. */
typedef struct acs_codec acs_codec;

/* Writes the defaults. options_size is sizeof of the caller's structure. */
ACS_C_EXPORT int32_t acs_codec_options_init(acs_codec_options* options, size_t options_size);

/* Creates a codec in *codec, to be destroyed by the caller; null after an error. abi_version is ACS_C_ABI_VERSION as the caller
 * was compiled. options may be null: the defaults. */
ACS_C_EXPORT int32_t acs_codec_create(uint32_t abi_version, const acs_codec_options* options, acs_codec** codec);

/* Null is allowed and does nothing. */
ACS_C_EXPORT void acs_codec_destroy(acs_codec* codec);

/* Decodes and normalises any bytes. ACS_ERROR_MESSAGE: the fields error... have the reason. */
ACS_C_EXPORT int32_t acs_codec_decode(acs_codec* codec, const char* text, size_t length, acs_message* message);

/* Makes a request with a new random transactionId and the time wall_ms from a command ("CancelPlan") and its payload, a JSON
 * object. ACS_ERROR_MESSAGE: the payload is not one of that command. */
ACS_C_EXPORT int32_t acs_codec_make_request(
    acs_codec* codec,
    const char* command,
    size_t command_length,
    const char* payload,
    size_t payload_length,
    int64_t wall_ms,
    acs_message* message);

/* Makes the Ack of a request. result: ACS_RESULT_. text: for the operator, at most ACS_MAX_NOTE_BYTES. payload: a JSON object; may
 * be null for an empty one. */
ACS_C_EXPORT int32_t acs_codec_make_ack(
    acs_codec* codec,
    const char* command,
    size_t command_length,
    const char* transaction_id,
    size_t transaction_id_length,
    int32_t result,
    const char* text,
    size_t text_length,
    const char* payload,
    size_t payload_length,
    int64_t wall_ms,
    acs_message* message);

/* ---- Actions of both sessions ------------------------------------------------------------------------------------------- */

/* A random source: 64 uniformly distributed bits. It must neither throw nor call the library, and is used until the handle is
 * destroyed. */
typedef uint64_t (*acs_random)(void* context);

#define ACS_ACTION_NONE 0         /* No action waits. */
#define ACS_ACTION_SEND_TEXT 1    /* Send text as one unfragmented text message. flag: may be dropped if the other side is slow. */
#define ACS_ACTION_CONNECT 2      /* ACS side. Open the connection, then report connected or closed. */
#define ACS_ACTION_CLOSE 3        /* Close the connection after what was sent before, with close_code and message; report closed. */
#define ACS_ACTION_START_TIMER 4  /* Report timer_elapsed after delay_ms. Replaces a running timer of the same name. */
#define ACS_ACTION_CANCEL_TIMER 5 /* A timer that elapses nevertheless is ignored. */
#define ACS_ACTION_EVENT 6        /* event has happened. */

#define ACS_TIMER_REGISTRATION 0 /* ACS side: the Ack of Registration. MCS side: the Registration of a connection. */
#define ACS_TIMER_ACK 1          /* The earliest deadline of an Ack. */
#define ACS_TIMER_RECONNECT 2    /* ACS side: the next attempt to connect. */
#define ACS_TIMER_POSITION 3     /* ACS side: the next position. */
#define ACS_TIMER_SHUTDOWN 4     /* ACS side: the end of acs_acs_stop. */
#define ACS_TIMER_ANSWER 5       /* MCS side: the earliest deadline of an answer of the caller. */

#define ACS_EVENT_NONE 0                 /* The action is not an event. */
#define ACS_EVENT_REGISTERED 1           /* ACS side: send stored reports with acs_acs_send, then call acs_acs_replay_done. */
#define ACS_EVENT_REGISTRATION_REFUSED 2 /* ACS side: message. The session tries again. */
#define ACS_EVENT_REQUEST_RECEIVED 3     /* text, command, transaction_id; MCS side: connection, token, flag: repeated. */
#define ACS_EVENT_REQUEST_REFUSED 4      /* ACS side: command, transaction_id, path and message of an invalid request. */
#define ACS_EVENT_ACKED 5                /* ACS side: command, transaction_id, result, message. The report may be forgotten. */
#define ACS_EVENT_REQUEST_ABANDONED 6    /* MCS side: command, transaction_id. The token was not answered in time. */
#define ACS_EVENT_ACK_RECEIVED 7         /* MCS side: text, command, transaction_id, result, message; flag: late. */
#define ACS_EVENT_REQUEST_UNANSWERED 8   /* command, transaction_id, reason, count: attempts. */
#define ACS_EVENT_LINK_LOST 9            /* message: the reason; flag: it was registered. */
#define ACS_EVENT_WINDOW_OPENED 10       /* ACS side: after ACS_ERROR_NOT_READY, acs_acs_send has room again. */
#define ACS_EVENT_POSITION_DUE 11        /* ACS side: send a RobotPositionUpdate. */
#define ACS_EVENT_STOPPED 12             /* ACS side: acs_acs_stop is complete. */
#define ACS_EVENT_NOTED 13 /* For the log: text names a deviation ("UnknownMember"), count, message: one sentence or empty. */

#define ACS_UNANSWERED_TIMEOUT 0   /* No Ack in time, after all resends. */
#define ACS_UNANSWERED_LINK_LOST 1 /* MCS side: the connection was lost. */
#define ACS_UNANSWERED_REPLACED 2  /* Another connection has registered. */

/* One action. Fields that its type does not use are 0 or empty. Its texts live until the next call of the next_action function with
 * the same handle, or until the handle is destroyed. */
typedef struct acs_action
{
    uint32_t struct_size;    /* Set by the caller. */
    int32_t type;            /* ACS_ACTION_ */
    int32_t event;           /* ACS_EVENT_ */
    int32_t timer;           /* ACS_TIMER_ */
    int32_t result;          /* ACS_RESULT_ */
    int32_t reason;          /* ACS_UNANSWERED_ */
    uint32_t close_code;     /* Of RFC 6455; 1006: end the connection at once, without a closing handshake. */
    uint32_t flag;           /* 0 or 1 */
    uint64_t connection;     /* MCS side; the ACS side has one connection, 0. */
    uint64_t token;          /* For acs_mcs_answer; 0: no answer is expected. */
    uint64_t count;          /* Attempts to send a request, or number of deviations. */
    int64_t delay_ms;        /* Of ACS_ACTION_START_TIMER, from the time of the call. */
    acs_text text;           /* To send; of an event the whole message, or the name of a deviation. */
    acs_text command;        /* Of the request, without Ack. */
    acs_text transaction_id; /* Of the request. */
    acs_text path;           /* JSON path of an invalid member; may be empty. */
    acs_text message;        /* For the operator or the log; may be empty. */
} acs_action;

/* ---- MCS side ----------------------------------------------------------------------------------------------------------- */

/* Times, limits and behaviour of an MCS side. The defaults are in brackets. */
typedef struct acs_mcs_options
{
    uint32_t struct_size; /* Set by the caller. */
    uint32_t ack_retries;            /* Resends of a request, only for an ACS that recognises a repeated one (0). */
    int64_t ack_timeout_ms;          /* Maximum time to wait for an Ack (5000). All times: 1 to ACS_DURATION_MAX_MS. */
    int64_t answer_timeout_ms;       /* Maximum time of the caller to answer (10000). */
    int64_t registration_timeout_ms; /* A connection without Registration is closed (10000). */
    uint64_t answer_bytes;           /* Size of the answers that are kept for repeated reports (4 MiB). */
    uint32_t max_pending;            /* Requests without an Ack (1024). */
    uint32_t duplicate_memory;       /* Transactions that are kept for repeated reports (4096). */
    uint32_t max_unanswered;         /* Reports that wait for the caller (256). */
    uint8_t silent_if_unanswered;    /* A report without an answer in time gets 0: Fail, 1: no Ack, so that it comes again (0). */
    uint8_t withhold_plans;          /* Send no ExecutionPlan while the ACS reports isConnected=false (1). */
    uint8_t refuse_second;           /* Refuse a second client instead of replacing the first (0). */
    uint8_t reserved;                /* 0 */
    /* The commands that the caller answers with acs_mcs_answer, separated by one space each ("Registration PlanReport"); data may
     * be null. The session answers all others with Success. Read by acs_mcs_create only. */
    acs_text answered_commands;
    acs_random random;       /* Null: the source of the operating system. */
    void* random_context;    /* Passed to each call of random; may be null. */
    acs_codec_options codec; /* Of the codec of the session. */
} acs_mcs_options;

/* The state of an MCS side. */
typedef struct acs_mcs_state
{
    uint32_t struct_size;     /* Set by the caller. */
    uint8_t registered;       /* Whether an ACS is registered: 0 or 1. */
    uint8_t takes_plans;      /* Otherwise acs_mcs_send refuses an ExecutionPlan, if withhold_plans is set. */
    uint8_t refuses_upgrade;  /* Answer a WebSocket upgrade with HTTP 403 now. */
    uint8_t reserved;         /* 0 */
    uint64_t connection;      /* The registered one; 0: none. */
    uint64_t pending;         /* Requests without an Ack. */
    uint64_t unanswered;      /* Requests that wait for acs_mcs_answer. */
    uint64_t waiting_actions; /* Take them with acs_mcs_next_action. */
} acs_mcs_state;

/* Handle of an MCS side. */
typedef struct acs_mcs acs_mcs;

/* Writes the defaults. options_size is sizeof of the caller's structure. */
ACS_C_EXPORT int32_t acs_mcs_options_init(acs_mcs_options* options, size_t options_size);

/* As acs_codec_create. */
ACS_C_EXPORT int32_t acs_mcs_create(uint32_t abi_version, const acs_mcs_options* options, acs_mcs** mcs);

/* Null is allowed and does nothing. */
ACS_C_EXPORT void acs_mcs_destroy(acs_mcs* mcs);

/* A client has connected. connection: a number above that of every earlier connection, from 1. */
ACS_C_EXPORT int32_t acs_mcs_connected(acs_mcs* mcs, uint64_t connection, int64_t steady_ms, int64_t wall_ms);

/* A whole message has come, any bytes. A text of an unknown connection is ignored. */
ACS_C_EXPORT int32_t acs_mcs_received(
    acs_mcs* mcs,
    uint64_t connection,
    const char* text,
    size_t length,
    int64_t steady_ms,
    int64_t wall_ms);

/* The connection was closed or lost. reason: for the log, at most ACS_MAX_NOTE_BYTES. */
ACS_C_EXPORT int32_t acs_mcs_closed(
    acs_mcs* mcs,
    uint64_t connection,
    const char* reason,
    size_t reason_length,
    int64_t steady_ms,
    int64_t wall_ms);

/* timer: ACS_TIMER_. A timer that is not running is ignored. */
ACS_C_EXPORT int32_t acs_mcs_timer_elapsed(acs_mcs* mcs, int32_t timer, int64_t steady_ms, int64_t wall_ms);

/* Sends a request of the MCS, a whole message with a new transactionId (acs_codec_make_request makes one). A missing timestamp is
 * replaced by wall_ms. ACS_OK: ends in one ACS_EVENT_ACK_RECEIVED or ACS_EVENT_REQUEST_UNANSWERED with this transactionId; no
 * effect if it is pending already. ACS_ERROR_MESSAGE, ACS_ERROR_DIRECTION, ACS_ERROR_NOT_READY: not sent. message may be null;
 * otherwise the message that was read, or why it is invalid. */
ACS_C_EXPORT int32_t acs_mcs_send(
    acs_mcs* mcs,
    const char* text,
    size_t length,
    int64_t steady_ms,
    int64_t wall_ms,
    acs_message* message);

/* Answers an ACS_EVENT_REQUEST_RECEIVED that has a token. result: ACS_RESULT_. text: for the operator, may be empty.
 * ACS_ERROR_NOT_WAITING: answered already, abandoned, or a Registration whose connection was closed. */
ACS_C_EXPORT int32_t acs_mcs_answer(
    acs_mcs* mcs,
    uint64_t token,
    int32_t result,
    const char* text,
    size_t text_length,
    int64_t steady_ms,
    int64_t wall_ms);

/* Takes the oldest action from the queue; ACS_ACTION_NONE: none waits. To be called after each function above, until none waits.
 * Carrying an action out may call the session again. */
ACS_C_EXPORT int32_t acs_mcs_next_action(acs_mcs* mcs, acs_action* action);

/* Writes the current state; the caller has set state->struct_size. */
ACS_C_EXPORT int32_t acs_mcs_get_state(acs_mcs* mcs, acs_mcs_state* state);

/* UTC offset of the timestamps that are sent from now on, and of those without one that are received; -1439 to 1439. */
ACS_C_EXPORT int32_t acs_mcs_set_site_offset(acs_mcs* mcs, int32_t minutes);

/* ---- ACS side ----------------------------------------------------------------------------------------------------------- */

/* Times, limits and behaviour of an ACS side. The defaults are in brackets. */
typedef struct acs_acs_options
{
    uint32_t struct_size;          /* Set by the caller. */
    uint32_t ack_retries;          /* Resends of one message per connection (3). */
    uint32_t ack_dead_after;       /* Consecutive messages without an Ack after which the connection is renewed; from 1 (5). */
    uint32_t window;               /* Maximum number of messages without an Ack; from 1 (16). */
    int64_t ack_timeout_ms;        /* Maximum time to wait for an Ack (5000). All times: 1 to ACS_DURATION_MAX_MS. */
    int64_t position_interval_ms;  /* Interval of ACS_EVENT_POSITION_DUE (200); 0 disables it. */
    int64_t answer_memory_ms;      /* How long an Ack is kept for repeated requests (600000). */
    int64_t shutdown_grace_ms;     /* Maximum time that acs_acs_stop waits for its last Ack (2000). */
    int64_t reconnect_initial_ms;  /* Delay before the second attempt to connect (500). */
    int64_t reconnect_max_ms;      /* Maximum delay; at least the initial one (10000). */
    uint64_t answer_bytes;         /* Maximum size of the Acks that are kept (4 MiB). */
    uint32_t answer_count;         /* Maximum number of Acks that are kept; from 1 (1024). */
    uint8_t match_acks_by_command; /* Match an Ack with an unknown transactionId to the oldest message of its command (1). */
    uint8_t reserved[3];           /* 0 */
    acs_random random;             /* Null: the source of the operating system. */
    void* random_context;          /* Passed to each call of random; may be null. */
    acs_codec_options codec;       /* Of the codec of the session. */
} acs_acs_options;

/* The state of an ACS side. */
typedef struct acs_acs_state
{
    uint32_t struct_size;     /* Set by the caller. */
    uint8_t registered;       /* Whether the MCS has accepted the Registration: 0 or 1. */
    uint8_t reserved[3];      /* 0 */
    uint64_t room;            /* Reports that acs_acs_send would accept now. */
    uint64_t waiting_actions; /* Take them with acs_acs_next_action. */
} acs_acs_state;

/* Handle of an ACS side. */
typedef struct acs_acs acs_acs;

/* Writes the defaults. options_size is sizeof of the caller's structure. */
ACS_C_EXPORT int32_t acs_acs_options_init(acs_acs_options* options, size_t options_size);

/* As acs_codec_create. */
ACS_C_EXPORT int32_t acs_acs_create(uint32_t abi_version, const acs_acs_options* options, acs_acs** acs);

/* Null is allowed and does nothing. */
ACS_C_EXPORT void acs_acs_destroy(acs_acs* acs);

/* Connects; no effect if the session is started already. It reconnects by itself. */
ACS_C_EXPORT int32_t acs_acs_start(acs_acs* acs, int64_t steady_ms, int64_t wall_ms);

/* Ends in ACS_EVENT_STOPPED. If registered, the ACS reports isConnected=false first. */
ACS_C_EXPORT int32_t acs_acs_stop(acs_acs* acs, int64_t steady_ms, int64_t wall_ms);

/* ACS_ACTION_CONNECT has succeeded. */
ACS_C_EXPORT int32_t acs_acs_connected(acs_acs* acs, int64_t steady_ms, int64_t wall_ms);

/* A whole message has come, any bytes. */
ACS_C_EXPORT int32_t acs_acs_received(acs_acs* acs, const char* text, size_t length, int64_t steady_ms, int64_t wall_ms);

/* The connection was closed, was lost or could not be opened. reason: for the log, at most ACS_MAX_NOTE_BYTES. */
ACS_C_EXPORT int32_t acs_acs_closed(acs_acs* acs, const char* reason, size_t reason_length, int64_t steady_ms, int64_t wall_ms);

/* timer: ACS_TIMER_. A timer that is not running is ignored. */
ACS_C_EXPORT int32_t acs_acs_timer_elapsed(acs_acs* acs, int32_t timer, int64_t steady_ms, int64_t wall_ms);

/* Sends a request of the ACS, a whole message. A missing timestamp is replaced by wall_ms. ACS_ERROR_MESSAGE, ACS_ERROR_DIRECTION:
 * not sent. message may be null; otherwise the message that was read, or why it is invalid.
 * - A report, with its own transactionId: ACS_OK: sent, or in flight already. ACS_ERROR_NOT_READY: not sent; keep it until
 *   ACS_EVENT_REGISTERED or ACS_EVENT_WINDOW_OPENED. Keep each report until ACS_EVENT_ACKED, and send it again after
 *   ACS_EVENT_REGISTERED with the same transactionId.
 * - TscStateUpdate, AcsCommStateUpdate, RobotStatusUpdate: the latest of each kind and robot is kept, and sent as soon as possible
 *   and after each registration. The session chooses the transactionId.
 * - RobotPositionUpdate: sent if a position was due on this connection, otherwise dropped. The session chooses the
 *   transactionId. */
ACS_C_EXPORT int32_t acs_acs_send(
    acs_acs* acs,
    const char* text,
    size_t length,
    int64_t steady_ms,
    int64_t wall_ms,
    acs_message* message);

/* Ends the replay after ACS_EVENT_REGISTERED, once for each connection, also if no report was stored. */
ACS_C_EXPORT int32_t acs_acs_replay_done(acs_acs* acs, int64_t steady_ms, int64_t wall_ms);

/* Answers an ACS_EVENT_REQUEST_RECEIVED with its Ack, a whole message (acs_codec_make_ack makes one). The first answer is kept for
 * repeated requests; a second one is ignored. message may be null. */
ACS_C_EXPORT int32_t acs_acs_answer(
    acs_acs* acs,
    const char* text,
    size_t length,
    int64_t steady_ms,
    int64_t wall_ms,
    acs_message* message);

/* As acs_mcs_next_action. */
ACS_C_EXPORT int32_t acs_acs_next_action(acs_acs* acs, acs_action* action);

/* Writes the current state; the caller has set state->struct_size. */
ACS_C_EXPORT int32_t acs_acs_get_state(acs_acs* acs, acs_acs_state* state);

/* UTC offset of the timestamps that are sent from now on, and of those without one that are received; -1439 to 1439. */
ACS_C_EXPORT int32_t acs_acs_set_site_offset(acs_acs* acs, int32_t minutes);

#ifdef __cplusplus
}
#endif

#endif
