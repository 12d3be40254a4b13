#include "view/StateViews.hpp"

#include "Catch.hpp"

namespace Acsctl = ACS::Acsctl;

TEST_CASE("The status shows isConnected as it was reported to the MCS, or that it was not yet")
{
    Acsctl::StatusInfo status;
    CHECK_THAT(Acsctl::PrintStatus(status, {}), Catch::Contains("not reported to the MCS yet"));
    status.bConnected = true;
    CHECK_THAT(Acsctl::PrintStatus(status, {}), Catch::Contains("yes, as reported to the MCS"));
    status.bConnected = false;
    CHECK_THAT(Acsctl::PrintStatus(status, {}), Catch::Contains("no, as reported to the MCS"));
}
