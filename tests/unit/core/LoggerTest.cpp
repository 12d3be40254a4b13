#include "Catch.hpp"
#include "RecordingLogSink.hpp"
#include <acs/core/Logger.hpp>

using ACS::Core::ELogLevel;
using ACS::Core::ILogSink;
using ACS::Core::LogField;
using ACS::Core::Logger;
using ACS::Testing::RecordingLogSink;

namespace
{

/// Accepts warnings and errors only, and counts them.
class QuietSink final : public ILogSink
{
    int _count = 0;

public:
    [[nodiscard]] bool ShouldWrite(ELogLevel level) const override
    {
        return level >= ELogLevel::Warning;
    }

    void Write(ELogLevel, std::string_view, std::string_view, std::initializer_list<LogField>) override
    {
        ++_count;
    }

    [[nodiscard]] int GetCount() const
    {
        return _count;
    }
};

} // namespace

TEST_CASE("A log line carries level, component, message and fields")
{
    RecordingLogSink sink;
    const Logger logger(sink, "mcs");
    logger.Debug("one");
    logger.Info("two", {{"planId", "PLAN-1"}});
    logger.Warning("three");
    logger.MakeFor("vda5050").Error("four");

    REQUIRE(sink.GetLines().size() == 4);
    CHECK(sink.GetLines()[0].level == ELogLevel::Debug);
    CHECK(sink.GetLines()[1].component == "mcs");
    CHECK(sink.GetLines()[1].HasField("planId", "PLAN-1"));
    CHECK(sink.GetLines()[3].component == "vda5050");
    CHECK(sink.Contains(ELogLevel::Error, "four"));
    CHECK_FALSE(sink.Contains(ELogLevel::Info, "four"));
    CHECK(sink.ContainsField("planId", "PLAN-1"));
    CHECK_FALSE(sink.ContainsField("planId", "PLAN-2"));
    CHECK(sink.CountLevel(ELogLevel::Warning) == 1);
}

TEST_CASE("A sink receives only the levels that it accepts")
{
    QuietSink sink;
    const Logger logger(sink, "mcs");
    logger.Debug("quiet");
    logger.Info("quiet");
    CHECK(sink.GetCount() == 0);
    logger.Warning("accepted");
    logger.Error("accepted");
    CHECK(sink.GetCount() == 2);
}

TEST_CASE("A logger without a sink discards its lines")
{
    CHECK_NOTHROW(Logger().Error("discarded"));
}
