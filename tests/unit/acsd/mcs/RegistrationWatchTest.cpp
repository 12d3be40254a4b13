#include "mcs/RegistrationWatch.hpp"

#include "Catch.hpp"

#include <string>

using namespace ACS; // NOLINT(google-build-using-namespace): a test of several of them

TEST_CASE("A refused registration stays the not-ready reason, also between two attempts, until the MCS is unreachable")
{
    Acsd::RegistrationWatch watch;
    CHECK(watch.GetObstacle(false) == "no connection: mcs");
    CHECK_FALSE(watch.IsRefused());
    watch.OnSessionEvent(Protocol::RegistrationRefused{"no\nready " + std::string(100'000, 'x')});
    CHECK(watch.GetObstacle(true).size() < 500);
    CHECK(watch.GetObstacle(true).find('\n') == std::string::npos);
    watch = {};
    watch.OnSessionEvent(Protocol::LinkLost{"Connection refused", false});
    CHECK(watch.GetObstacle(false) == "no connection: mcs: Connection refused");
    CHECK(watch.GetObstacle(true) == "connected, not registered: mcs: registration not answered yet");
    const std::string refused = "connected, not registered: mcs: registration refused: \"not you\"";
    for (int count = 0; count < 2; ++count)
    {
        watch.OnSessionEvent(Protocol::RegistrationRefused{"not you"});
        CHECK(watch.GetObstacle(true) == refused);
        CHECK(watch.IsRefused());
        watch.OnSessionEvent(Protocol::LinkLost{"registration refused", false});
        CHECK(watch.GetObstacle(false) == refused);
        CHECK(watch.GetObstacle(true) == refused);
    }
    watch.OnSessionEvent(Protocol::LinkLost{"Connection refused", false});
    CHECK(watch.GetObstacle(false) == "no connection: mcs: Connection refused");
    watch.OnSessionEvent(Protocol::ProtocolNoted{Protocol::EProtocolNote::RegistrationUnanswered, 1, {}});
    watch.OnSessionEvent(Protocol::LinkLost{"no answer to Registration", false});
    CHECK(watch.GetObstacle(false) == "connected, not registered: mcs: registration not answered");
    watch.OnSessionEvent(Protocol::RegistrationRefused{});
    CHECK(watch.GetObstacle(true) == "connected, not registered: mcs: registration refused");
    watch.OnSessionEvent(Protocol::Registered{});
    CHECK(watch.GetObstacle(false) == "no connection: mcs");
}
