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

/* Results. */
#define ACS_OK 0
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

/* Limits. */
#define ACS_TIME_MAX_MS 8000000000000 /* Of a time: year 2223. */
#define ACS_DURATION_MAX_MS 86400000  /* Of a duration: one day. */
#define ACS_COUNT_MAX 1048576u        /* Of a count in the options. */
#define ACS_SIZE_MAX 268435456u       /* Of a size in bytes in the options: 256 MiB. */
#define ACS_MAX_ACTIONS 65536u        /* Actions that wait in a handle; one call may exceed it. */
#define ACS_MAX_NOTE_BYTES 65536u     /* Of a reason or of the message of an answer. */

typedef struct acs_text
{
    const char* data;
    size_t length;
} acs_text;

/* Writes ACS_C_ABI_VERSION of the library. */
ACS_C_EXPORT int32_t acs_c_abi_version(uint32_t* version);

/* Writes the version of the SDK, "0.1.0". The text is static. */
ACS_C_EXPORT int32_t acs_c_version(acs_text* version);

/* Writes a short English text for a result, also for an unknown one. The text is static. */
ACS_C_EXPORT int32_t acs_c_describe(int32_t result, acs_text* text);

/* ---- Codec ---------------------------------------------------------------------------------------------------------------- */

/* What is accepted from the other side. */
typedef struct acs_codec_options
{
    uint32_t struct_size;
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

#define ACS_KIND_INVALID 0
#define ACS_KIND_REQUEST 1
#define ACS_KIND_ACK 2

#define ACS_RESULT_SUCCESS 0
#define ACS_RESULT_FAIL 1

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

/* Makes the Ack of a request. result: ACS_RESULT_. text: for the operator, at most ACS_MAX_NOTE_BYTES. payload: a JSON object; may be
 * null for an empty one. */
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

#ifdef __cplusplus
}
#endif

#endif
