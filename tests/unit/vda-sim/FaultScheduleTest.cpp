#include "vda-sim/FaultSchedule.hpp"

#include "Catch.hpp"

#include <chrono>
#include <cstddef>
#include <optional>

namespace ACS::Testing
{
namespace
{

using namespace std::chrono_literals;
using VdaSim::EFaultKind;
using VdaSim::Fault;
using VdaSim::FaultBoard;
using VdaSim::FaultSchedule;

constexpr Core::SteadyTime ADDED_AT{1h};

Fault MakeFault(EFaultKind kind)
{
    Fault fault;
    fault.kind = kind;
    return fault;
}

} // namespace

TEST_CASE("FaultSchedule: the delay of a fault counts from the first time that the vehicle is online")
{
    FaultSchedule faults;
    Fault fault = MakeFault(EFaultKind::Stuck);
    fault.delay = 5s;
    REQUIRE(faults.TryAdd(fault, ADDED_AT));
    CHECK(faults.GetBoard().IsEmpty());
    faults.OnLinkUp(ADDED_AT + 1min);
    CHECK(faults.WasOnline());
    CHECK(faults.TakeChanges().empty());
    CHECK(faults.GetBoard().GetNextTimeOrNull() == ADDED_AT + 65s);
    faults.OnLinkUp(ADDED_AT + 62s); // a reconnect changes nothing
    faults.OnTime(ADDED_AT + 65s);
    CHECK(faults.GetBoard().IsActive(EFaultKind::Stuck));
    CHECK(faults.TakeChanges().size() == 1);
    CHECK(faults.TakeChanges().empty());
}

TEST_CASE("FaultSchedule: those that wait can be ended, which is no change, and count for the limit")
{
    FaultSchedule faults;
    REQUIRE(faults.TryAdd(MakeFault(EFaultKind::Lost), ADDED_AT));
    for (std::size_t i = 1; i < FaultBoard::MAX_FAULTS; ++i)
    {
        REQUIRE(faults.TryAdd(MakeFault(EFaultKind::Stuck), ADDED_AT));
    }
    CHECK_FALSE(faults.TryAdd(MakeFault(EFaultKind::Stuck), ADDED_AT));
    CHECK(faults.End(EFaultKind::Stuck, "test") == FaultBoard::MAX_FAULTS - 1);
    CHECK(faults.TakeChanges().empty());
    faults.OnLinkUp(ADDED_AT);
    CHECK(faults.GetBoard().IsActive(EFaultKind::Lost));
    CHECK(faults.End(std::nullopt, "test") == 1);
    CHECK(faults.TakeChanges().size() == 2);
}

} // namespace ACS::Testing
