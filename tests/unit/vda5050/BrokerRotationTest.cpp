#include "BrokerRotation.hpp"

#include "Catch.hpp"

#include <cstddef>
#include <vector>

namespace ACS::VDA5050
{

TEST_CASE("A broker that is the only one is tried again and again, and each failure ends a round")
{
    BrokerRotation rotation(1);
    CHECK(rotation.GetCurrent() == 0);
    CHECK(rotation.GetNext() == 0);
    for (int attempt = 0; attempt < 3; ++attempt)
    {
        rotation.MoveOn();
        CHECK(rotation.GetCurrent() == 0);
        CHECK(rotation.IsRoundOver());
    }
}

TEST_CASE("Several brokers are tried in their order from the first one on; a round is over when each has failed once")
{
    BrokerRotation rotation(3);
    CHECK_FALSE(rotation.IsRoundOver());
    std::vector<std::size_t> tried;
    std::vector<bool> over;
    for (int attempt = 0; attempt < 7; ++attempt)
    {
        tried.push_back(rotation.GetCurrent());
        CHECK(rotation.GetNext() == (rotation.GetCurrent() + 1) % 3);
        rotation.MoveOn();
        over.push_back(rotation.IsRoundOver());
    }
    CHECK(tried == std::vector<std::size_t>{0, 1, 2, 0, 1, 2, 0});
    CHECK(over == std::vector<bool>{false, false, true, false, false, true, false});
}

TEST_CASE("After a stable connection a round begins with its broker, and the next broker follows it")
{
    BrokerRotation rotation(3);
    rotation.MoveOn();
    rotation.MoveOn();
    rotation.BeginRound();
    CHECK(rotation.GetCurrent() == 2); // it does not return to the first one
    std::vector<std::size_t> tried;
    do
    {
        tried.push_back(rotation.GetCurrent());
        rotation.MoveOn();
    }
    while (!rotation.IsRoundOver());
    CHECK(tried == std::vector<std::size_t>{2, 0, 1});
}

TEST_CASE("Connections that end before they are stable do not begin a round")
{
    BrokerRotation rotation(2);
    rotation.MoveOn(); // connected to the second one, and lost at once
    rotation.MoveOn();
    CHECK(rotation.IsRoundOver());
}

} // namespace ACS::VDA5050
