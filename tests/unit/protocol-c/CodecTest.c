/* The codec of the C interface: messages, errors with their path, and every kind of bad argument. */
#include "Check.h"

#include <stdlib.h>

static const char CANCEL[] = "{\"payload\":{\"planId\":\"P-1\"},\"command\":\"CancelPlan\",\"transactionId\":\"t-1\","
                             "\"timestamp\":\"2025-07-02T21:00:00.123+09:00\",\"extra\":1}";

static acs_message make_message(void)
{
    acs_message message;
    memset(&message, 0, sizeof message);
    message.struct_size = sizeof message;
    return message;
}

static acs_codec* make_codec(void)
{
    acs_codec* codec = NULL;
    CHECK(acs_codec_create(ACS_C_ABI_VERSION, NULL, &codec) == ACS_OK);
    return codec;
}

static int32_t decode(acs_codec* codec, const char* text, acs_message* message)
{
    return acs_codec_decode(codec, text, strlen(text), message);
}

static void test_version(void)
{
    uint32_t number = 0;
    acs_text text;
    int32_t result = 0;
    CHECK(acs_c_abi_version(&number) == ACS_OK && number == ACS_C_ABI_VERSION);
    CHECK(acs_c_abi_version(NULL) == ACS_ERROR_ARGUMENT);
    CHECK(acs_c_version(&text) == ACS_OK && text.length >= 5);
    CHECK(acs_c_version(NULL) == ACS_ERROR_ARGUMENT);
    for (result = -1; result <= ACS_ERROR_UTF8 + 1; ++result)
    {
        CHECK(acs_c_describe(result, &text) == ACS_OK && text.length > 0);
    }
    CHECK_TEXT(text, "Unknown result.");
    CHECK(acs_c_describe(ACS_OK, NULL) == ACS_ERROR_ARGUMENT);
}

static void test_create(void)
{
    acs_codec* codec = (acs_codec*)&failures;
    acs_codec_options options;
    CHECK(acs_codec_create(ACS_C_ABI_VERSION + 1, NULL, &codec) == ACS_ERROR_VERSION && codec == NULL);
    CHECK(acs_codec_create(ACS_C_ABI_VERSION, NULL, NULL) == ACS_ERROR_ARGUMENT);
    CHECK(acs_codec_options_init(NULL, sizeof options) == ACS_ERROR_ARGUMENT);
    CHECK(acs_codec_options_init(&options, sizeof options - 1) == ACS_ERROR_VERSION);

    CHECK(acs_codec_options_init(&options, sizeof options) == ACS_OK);
    CHECK(options.max_bytes == 4u * 1024u * 1024u && options.max_depth == 64 && options.accept_legacy_names == 1);
    options.struct_size -= 4;
    CHECK(acs_codec_create(ACS_C_ABI_VERSION, &options, &codec) == ACS_ERROR_VERSION && codec == NULL);
    options.struct_size += 4;
    options.max_depth = 0;
    CHECK(acs_codec_create(ACS_C_ABI_VERSION, &options, &codec) == ACS_ERROR_ARGUMENT && codec == NULL);
    options.max_depth = 64;
    options.site_offset_minutes = 24 * 60;
    CHECK(acs_codec_create(ACS_C_ABI_VERSION, &options, &codec) == ACS_ERROR_ARGUMENT);
    options.site_offset_minutes = 540;
    options.max_bytes = sizeof CANCEL;
    CHECK(acs_codec_create(ACS_C_ABI_VERSION, &options, &codec) == ACS_OK && codec != NULL);
    acs_codec_destroy(codec);
    acs_codec_destroy(NULL);
}

static void test_decode(void)
{
    acs_codec* codec = make_codec();
    acs_message message = make_message();
    CHECK(decode(codec, CANCEL, &message) == ACS_OK);
    CHECK(message.kind == ACS_KIND_REQUEST && message.notes == 1);
    CHECK_TEXT(message.command, "CancelPlan");
    CHECK_TEXT(message.transaction_id, "t-1");
    CHECK_TEXT(
        message.text,
        "{\"command\":\"CancelPlan\",\"transactionId\":\"t-1\",\"timestamp\":\"2025-07-02T21:00:00.123+09:00\","
        "\"payload\":{\"planId\":\"P-1\"}}");
    CHECK_TEXT(message.error, "");

    CHECK(
        decode(
            codec,
            "{\"command\":\"CancelPlanAck\",\"transactionId\":\"t-1\",\"result\":\"Fail\",\"message\":\"m\"}",
            &message)
        == ACS_OK);
    CHECK(message.kind == ACS_KIND_ACK && message.result == ACS_RESULT_FAIL);
    CHECK_TEXT(message.command, "CancelPlan");
    CHECK_TEXT(message.message, "m");
    acs_codec_destroy(codec);
}

static void test_invalid_texts(void)
{
    acs_codec* codec = make_codec();
    acs_message message = make_message();
    const size_t huge = 5u * 1024u * 1024u;
    char* text = malloc(huge);
    size_t length = 0;

    CHECK(
        decode(codec, "{\"command\":\"CancelPlan\",\"transactionId\":\"t-1\",\"payload\":{\"planId\":7}}", &message)
        == ACS_ERROR_MESSAGE);
    CHECK(message.kind == ACS_KIND_INVALID);
    CHECK_TEXT(message.command, "CancelPlan");
    CHECK_TEXT(message.transaction_id, "t-1");
    CHECK_TEXT(message.error_path, "payload.planId");
    CHECK_TEXT(message.text, "");
    CHECK(message.error.length > 0 && message.error_expected.length > 0 && message.error_found.length > 0);

    for (length = 0; length < sizeof CANCEL - 1; ++length)
    {
        CHECK(acs_codec_decode(codec, CANCEL, length, &message) == ACS_ERROR_MESSAGE);
        CHECK(message.error.length > 0);
    }
    CHECK(decode(codec, "{\"command\":\"\xff\"}", &message) == ACS_ERROR_MESSAGE);
    CHECK(
        decode(codec, "{\"command\":\"Dance\",\"transactionId\":\"t-1\",\"payload\":{}}", &message)
        == ACS_ERROR_MESSAGE);
    CHECK_TEXT(message.error_path, "command");
    if (text != NULL)
    {
        memset(text, '[', huge);
        CHECK(acs_codec_decode(codec, text, huge, &message) == ACS_ERROR_MESSAGE);
        CHECK(acs_codec_decode(codec, text, 1000, &message) == ACS_ERROR_MESSAGE);
        CHECK(acs_codec_make_request(codec, "CancelPlan", 10, text, huge, 0, &message) == ACS_ERROR_MESSAGE);
        CHECK(acs_codec_make_request(codec, text, huge, "{}", 2, 0, &message) == ACS_ERROR_ARGUMENT);
    }
    free(text);
    acs_codec_destroy(codec);
}

static void test_make(void)
{
    acs_codec* codec = make_codec();
    acs_message message = make_message();
    const char payload[] = "{\"planId\":\"P-1\"}";
    const size_t size = sizeof payload - 1;
    const char escape[] = "{},\"command\":\"AbortPlan\"";
    CHECK(acs_codec_make_request(codec, "CancelPlan", 10, payload, size, 1751457600123, &message) == ACS_OK);
    CHECK(message.kind == ACS_KIND_REQUEST && message.transaction_id.length == 36);
    CHECK(has(message.text, "\"timestamp\":\"2025-07-02T12:00:00.123+00:00\",\"payload\":{\"planId\":\"P-1\"}}"));
    CHECK(acs_codec_make_request(codec, "CancelPlan", 10, "{}", 2, 0, &message) == ACS_ERROR_MESSAGE);
    CHECK_TEXT(message.error_path, "payload.planId");
    CHECK(acs_codec_make_request(codec, "CancelPlan", 10, escape, sizeof escape - 1, 0, &message) == ACS_ERROR_MESSAGE);
    CHECK(acs_codec_make_request(codec, "CancelPlanAck", 13, payload, size, 0, &message) == ACS_ERROR_DIRECTION);
    CHECK(acs_codec_make_request(codec, "Cancel\"Plan", 11, payload, size, 0, &message) == ACS_ERROR_MESSAGE);
    CHECK(acs_codec_make_request(codec, "\xc3", 1, payload, size, 0, &message) == ACS_ERROR_UTF8);
    CHECK(acs_codec_make_request(codec, "CancelPlan", 10, payload, size, -1, &message) == ACS_ERROR_ARGUMENT);

    CHECK(
        acs_codec_make_ack(
            codec,
            "CancelPlan",
            10,
            "t-1",
            3,
            ACS_RESULT_FAIL,
            "no \"P-1\"",
            8,
            payload,
            size,
            0,
            &message)
        == ACS_OK);
    CHECK(message.kind == ACS_KIND_ACK && message.result == ACS_RESULT_FAIL);
    CHECK_TEXT(message.message, "no \"P-1\"");
    CHECK(has(message.text, "\"command\":\"CancelPlanAck\",\"transactionId\":\"t-1\""));
    CHECK(
        acs_codec_make_ack(codec, "PlanReport", 10, "t-1", 3, ACS_RESULT_SUCCESS, "", 0, NULL, 0, 0, &message)
        == ACS_OK);
    CHECK(has(message.text, "\"payload\":{}"));
    CHECK(acs_codec_make_ack(codec, "PlanReport", 10, "t-1", 3, 2, "", 0, NULL, 0, 0, &message) == ACS_ERROR_ARGUMENT);
    CHECK(
        acs_codec_make_ack(codec, "Dance", 5, "t-1", 3, ACS_RESULT_SUCCESS, "", 0, NULL, 0, 0, &message)
        == ACS_ERROR_MESSAGE);
    acs_codec_destroy(codec);
}

static void test_null_arguments(void)
{
    acs_codec* codec = make_codec();
    acs_message message = make_message();
    CHECK(acs_codec_decode(NULL, "", 0, &message) == ACS_ERROR_ARGUMENT);
    CHECK(acs_codec_decode(codec, NULL, 5, &message) == ACS_ERROR_ARGUMENT);
    CHECK(acs_codec_decode(codec, "", 0, NULL) == ACS_ERROR_ARGUMENT);
    CHECK(acs_codec_make_request(NULL, "CancelPlan", 10, "{}", 2, 0, &message) == ACS_ERROR_ARGUMENT);
    CHECK(acs_codec_make_request(codec, NULL, 10, "{}", 2, 0, &message) == ACS_ERROR_ARGUMENT);
    CHECK(acs_codec_make_request(codec, "CancelPlan", 10, NULL, 2, 0, &message) == ACS_ERROR_ARGUMENT);
    CHECK(acs_codec_make_request(codec, "CancelPlan", 10, "{}", 2, 0, NULL) == ACS_ERROR_ARGUMENT);
    CHECK(acs_codec_make_ack(NULL, "PlanReport", 10, "t", 1, 0, "", 0, NULL, 0, 0, &message) == ACS_ERROR_ARGUMENT);
    CHECK(acs_codec_make_ack(codec, NULL, 10, "t", 1, 0, "", 0, NULL, 0, 0, &message) == ACS_ERROR_ARGUMENT);
    CHECK(acs_codec_make_ack(codec, "PlanReport", 10, NULL, 1, 0, "", 0, NULL, 0, 0, &message) == ACS_ERROR_ARGUMENT);
    CHECK(acs_codec_make_ack(codec, "PlanReport", 10, "t", 1, 0, NULL, 0, NULL, 0, 0, &message) == ACS_ERROR_ARGUMENT);
    CHECK(acs_codec_make_ack(codec, "PlanReport", 10, "t", 1, 0, "", 0, NULL, 0, 0, NULL) == ACS_ERROR_ARGUMENT);
    CHECK(acs_codec_make_ack(codec, "PlanReport", 10, "t", 1, 0, "", 0, NULL, 2, 0, &message) == ACS_ERROR_ARGUMENT);
    message.struct_size = 0;
    CHECK(acs_codec_decode(codec, CANCEL, sizeof CANCEL - 1, &message) == ACS_ERROR_VERSION);
    CHECK(message.text.data == NULL);
    acs_codec_destroy(codec);
}

int main(void)
{
    test_version();
    test_create();
    test_decode();
    test_invalid_texts();
    test_make();
    test_null_arguments();
    return report();
}
