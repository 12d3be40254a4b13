#include "mcs/McsNoteLog.hpp"

#include "Catch.hpp"
#include "RecordingLogSink.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

using namespace ACS; // NOLINT(google-build-using-namespace): a test of several of them
using Protocol::EProtocolNote;

namespace
{

struct NoteLogFixture
{
    Testing::RecordingLogSink sink;
    Acsd::McsNoteLog log{Core::Logger(sink, "mcs")};
    Core::SteadyTime now;
    std::uint64_t total = 0;

    void Take(EProtocolNote what, const std::string& detail)
    {
        log.OnNoted({what, 1, detail}, ++total, now);
    }
};

} // namespace

TEST_CASE_METHOD(NoteLogFixture, "A refused message is not logged as a note, and does not count against the rate limit")
{
    for (std::size_t count = 0; count < 100; ++count)
    {
        Take(EProtocolNote::Undecodable, "payload.steps: expected a list, found 7");
        log.Drop();
    }
    CHECK(sink.GetLines().empty());
    Take(EProtocolNote::Undecodable, "expected a JSON text, found {");
    log.Flush(now);
    REQUIRE(sink.GetLines().size() == 1);
    CHECK(sink.GetLines().front().level == Core::ELogLevel::Warning);
    CHECK(sink.GetLines().front().message == "the MCS deviates from the protocol");
    CHECK(sink.GetLines().front().HasField("detail", "expected a JSON text, found {"));
    CHECK(sink.GetLines().front().HasField("count", "101"));
    log.Flush(now);
    CHECK(sink.GetLines().size() == 1);
}

TEST_CASE_METHOD(NoteLogFixture, "Each kind of deviation is rate-limited per reason, whatever the value")
{
    for (int count = 0; count < 100; ++count)
    {
        Take(EProtocolNote::Undecodable, "command: expected a string, found " + std::to_string(count));
    }
    log.Flush(now);
    CHECK(sink.GetLines().size() == Apps::LogRateLimiter::BURST);
    Take(EProtocolNote::Undecodable, "transactionId: expected a string, found 1");
    Take(EProtocolNote::AckUnexpected, "PlanReport");
    CHECK(sink.GetLines().size() == Apps::LogRateLimiter::BURST + 2);
    Take(EProtocolNote::UnknownMember, {});
    CHECK(sink.GetLines().back().level == Core::ELogLevel::Debug);
}
