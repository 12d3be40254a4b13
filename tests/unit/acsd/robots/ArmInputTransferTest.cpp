#include "robots/ArmInputTransfer.hpp"

#include "Catch.hpp"

#include <cstdint>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

/// ml105 and ml106 are the words at byte 420.
std::vector<ArmRelayWords> MakeWords(std::vector<std::int64_t> words)
{
    const auto count = static_cast<std::uint32_t>(words.size());
    return {{{"/project/plc/m/val_s32", 420, count}, std::move(words)}};
}

ArmInputTransfer MakeTransfer(std::size_t retryLimit)
{
    return {{{*ParseArmRelay("ml105"), 7}, {*ParseArmRelay("ml106"), 8}}, retryLimit};
}

} // namespace

TEST_CASE("Inputs are written one after the other, and from the first again after Begin")
{
    ArmInputTransfer transfer = MakeTransfer(0);
    CHECK(transfer.GetCurrent().relay.name == "ml105");
    CHECK(transfer.TryNext());
    CHECK(transfer.GetCurrent().relay.name == "ml106");
    CHECK_FALSE(transfer.TryNext());
    transfer.Begin();
    CHECK(transfer.GetCurrent().relay.name == "ml105");
}

TEST_CASE("Inputs are verified when every relay reads as it was written, otherwise the first difference is described")
{
    ArmInputTransfer transfer = MakeTransfer(0);
    CHECK(transfer.DescribeDifference() == "the relays are not shown");
    CHECK_FALSE(transfer.TryVerify(MakeWords({7, 9})));
    CHECK(transfer.DescribeDifference() == "relay ml106 was written as 8 and reads 9");
    CHECK_FALSE(transfer.TryVerify(MakeWords({7})));
    CHECK(transfer.DescribeDifference() == "relay ml106 was written as 8 and reads nothing");
    transfer.BeginReading();
    CHECK(transfer.DescribeDifference() == "the relays are not shown");
    CHECK(transfer.TryVerify(MakeWords({7, 8})));
}

TEST_CASE("Inputs that differ are written again from the first, at most as often as configured")
{
    ArmInputTransfer transfer = MakeTransfer(2);
    CHECK(transfer.TryNext());
    CHECK(transfer.TryRetry());
    CHECK(transfer.GetCurrent().relay.name == "ml105");
    CHECK(transfer.TryRetry());
    CHECK_FALSE(transfer.TryRetry());
    transfer.Begin();
    CHECK(transfer.TryRetry());
}

} // namespace ACS::Acsd::Test
