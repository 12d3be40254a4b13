#include "Catch.hpp"
#include <acs/vda5050/ActionMachine.hpp>

#include <array>
#include <string>

namespace ACS::VDA5050::Test
{

TEST_CASE("5.1 The transition table of action statuses")
{
    constexpr std::array<std::string_view, 6> ROWS{           // to: W I R P D F (D: finished)
                                                   ".yy.yy",  // from waiting
                                                   "..yy.y",  // initializing
                                                   "...yyy",  // running
                                                   ".yy..y",  // paused
                                                   "......",  // finished
                                                   "......"}; // failed
    for (unsigned from = 0; from < ROWS.size(); ++from)
    {
        for (unsigned to = 0; to < ROWS.size(); ++to)
        {
            CAPTURE(from, to);
            const bool bAllowed = ROWS.at(from).at(to) == 'y';
            CHECK(CanChangeStatus(static_cast<EActionStatus>(from), static_cast<EActionStatus>(to)) == bAllowed);
        }
    }
}

TEST_CASE("5.1 A terminal status never changes, whatever status is reported")
{
    ActionMachine machine(ActionState{"a1", "pick", {}, EActionStatus::Running, {}});
    CHECK(machine.TrySet(EActionStatus::Running, "half"));
    CHECK(machine.GetState().resultDescription == "half");
    CHECK(machine.TrySet(EActionStatus::Finished, "done"));
    CHECK_FALSE(machine.TrySet(EActionStatus::Failed, "no"));
    CHECK_FALSE(machine.TrySet(EActionStatus::Finished, "again"));
    CHECK(machine.GetState().resultDescription == "done");
    CHECK(GetStatusText(machine.GetStatus()) == "FINISHED");
}

} // namespace ACS::VDA5050::Test
