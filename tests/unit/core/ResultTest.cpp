#include "Catch.hpp"
#include <acs/core/Result.hpp>

using ACS::Core::Describe;
using ACS::Core::ECoreError;
using ACS::Core::Error;
using ACS::Core::Fail;
using ACS::Core::QuoteForError;
using ACS::Core::Result;

TEST_CASE("The text of an error has its place, what was expected and what was found")
{
    const Error whole{ECoreError::OutOfRange, "payload.steps[0].seq", "an integer from 1 to 100", "0"};
    CHECK(Describe(whole) == "payload.steps[0].seq: expected an integer from 1 to 100, found 0");

    const Error codeOnly{ECoreError::QueueFull, {}, {}, {}};
    CHECK(Describe(codeOnly) == "a queue is full");

    const Error withoutPath{ECoreError::InvalidLocation, {}, "a location", {}};
    CHECK(Describe(withoutPath) == "expected a location");
}

TEST_CASE("A failed result is equal to its enumerator")
{
    const Result<int> result = Fail(ECoreError::MissingField, "command");
    REQUIRE_FALSE(result.has_value());
    CHECK(result.error().code == ECoreError::MissingField);
    CHECK(result.error().code != ECoreError::WrongType);
    CHECK(result.error().path == "command");
}

TEST_CASE("Every core error has its own message")
{
    constexpr int LAST = static_cast<int>(ECoreError::UnhandledEnum);
    const std::error_category& category = make_error_code(ECoreError::InvalidJSON).category();
    CHECK(std::string(category.name()) == "acs.core");
    for (int value = 1; value <= LAST; ++value)
    {
        CHECK(category.message(value) != "unknown error");
    }
    CHECK(category.message(0) == "unknown error");
    CHECK(category.message(LAST + 1) == "unknown error");
}

TEST_CASE("Text from outside is shortened and made printable")
{
    CHECK(QuoteForError("A01.CP1") == "\"A01.CP1\"");
    CHECK(QuoteForError("a\n\x7f\xff") == "\"a???\"");
    CHECK(QuoteForError(std::string(64, 'x')) == "\"" + std::string(64, 'x') + "\"");
    CHECK(QuoteForError(std::string(65, 'x')) == "\"" + std::string(64, 'x') + "\"...");
}
