#include "wire/WireFilter.hpp"

#include "Catch.hpp"
#include "wire/RawPeer.hpp"

#include <string>

using ACS::McsSim::WireFilter;
using ACS::ProtocolBeast::EWireDirection;
using ACS::Testing::MakeText;

namespace
{

std::string MakeAck(const std::string& result)
{
    return R"({"command":"RegistrationAck","transactionId":"T","timestamp":"2025-07-02T21:00:00.123+09:00","result":")"
        + result + R"(","message":"","payload":{}})";
}

} // namespace

TEST_CASE("Only messages of the registered ACS, and Registrations, reach a scenario")
{
    const std::string report = MakeText("TscStateUpdate", "T", R"({"state":"Auto"})");
    const std::string registration = MakeText("Registration", "T", "{}");
    WireFilter filter;
    CHECK_FALSE(filter.ShouldPass(EWireDirection::In, 1, report));
    CHECK_FALSE(filter.ShouldPass(EWireDirection::In, 1, "rubbish"));
    CHECK(filter.ShouldPass(EWireDirection::In, 1, registration));
    CHECK_FALSE(filter.ShouldPass(EWireDirection::Out, 1, MakeAck("Fail")));
    CHECK_FALSE(filter.ShouldPass(EWireDirection::In, 1, report));
    CHECK_FALSE(filter.ShouldPass(EWireDirection::Out, 1, MakeAck("Success")));
    CHECK(filter.ShouldPass(EWireDirection::In, 1, report));
    CHECK(filter.ShouldPass(EWireDirection::In, 1, "rubbish"));
    CHECK_FALSE(filter.ShouldPass(EWireDirection::In, 2, report));
    CHECK(filter.ShouldPass(EWireDirection::In, 2, registration));
    CHECK(filter.ShouldPass(EWireDirection::In, 2, MakeText("Registration", "T", "null")));
    CHECK(filter.ShouldPass(EWireDirection::In, 1, report));
    CHECK_FALSE(filter.ShouldPass(EWireDirection::Out, 2, MakeAck("Success")));
    CHECK_FALSE(filter.ShouldPass(EWireDirection::In, 1, report));
    CHECK(filter.ShouldPass(EWireDirection::In, 2, report));
}
