#include "faults/FaultSchedule.hpp"

#include "Catch.hpp"

#include <cstddef>
#include <optional>
#include <set>

using namespace ACS::AcsSim; // NOLINT(google-build-using-namespace)

TEST_CASE("Each fault has a name of its own that is read back")
{
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < FAULT_COUNT; ++i)
    {
        const auto fault = static_cast<EFault>(i);
        CHECK(names.insert(GetName(fault)).second);
        CHECK(ReadFaultOrNull(GetName(fault)) == fault);
    }
    CHECK_FALSE(ReadFaultOrNull("").has_value());
    CHECK_FALSE(ReadFaultOrderOrNull("malformed=").has_value());
    CHECK_FALSE(ReadFaultOrderOrNull("=always").has_value());
    CHECK_FALSE(ReadFaultOrderOrNull("malformed=99999999999999999999").has_value());
}

TEST_CASE("Faults take turns until each has occurred as often as it shall")
{
    FaultSchedule schedule({{EFault::Malformed, 2}, {EFault::Reconnect, 1}});
    CHECK(schedule.HasCounted());
    CHECK(schedule.ExtractNextOrNull() == EFault::Malformed);
    CHECK(schedule.ExtractNextOrNull() == EFault::Reconnect);
    CHECK(schedule.ExtractNextOrNull() == EFault::Malformed);
    CHECK_FALSE(schedule.HasCounted());
    CHECK(schedule.ExtractNextOrNull() == std::nullopt);
}

TEST_CASE("A fault without a count occurs again and again, and nothing waits for it")
{
    FaultSchedule schedule({{EFault::LateAck, std::nullopt}, {EFault::Reconnect, 1}});
    CHECK(schedule.ExtractNextOrNull() == EFault::LateAck);
    CHECK(schedule.HasCounted());
    CHECK(schedule.ExtractNextOrNull() == EFault::Reconnect);
    CHECK_FALSE(schedule.HasCounted());
    CHECK(schedule.ExtractNextOrNull() == EFault::LateAck);
    CHECK(schedule.ExtractNextOrNull() == EFault::LateAck);
    CHECK(FaultSchedule().ExtractNextOrNull() == std::nullopt);
}
