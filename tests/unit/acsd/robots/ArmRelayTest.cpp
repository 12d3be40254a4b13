#include "robots/ArmRelay.hpp"

#include "Catch.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

ArmRelay Parse(std::string_view name)
{
    const tl::expected<ArmRelay, std::string> relay = ParseArmRelay(name);
    INFO(name);
    REQUIRE(relay.has_value());
    CHECK(relay->name == name);
    return *relay;
}

} // namespace

TEST_CASE("A relay's name gives where val_s32 shows it")
{
    CHECK(Parse("ml105") == ArmRelay{"ml105", "/project/plc/m/val_s32", EArmRelayWidth::Long, 420, 0});
    CHECK(Parse("fb0.mw12") == ArmRelay{"fb0.mw12", "/project/plc/fb0_m/val_s32", EArmRelayWidth::Word, 24, 0});
    CHECK(Parse("do3") == ArmRelay{"do3", "/project/plc/do/val_s32", EArmRelayWidth::Bit, 0, 3});
    CHECK(Parse("fn63.di17") == ArmRelay{"fn63.di17", "/project/plc/fn63_di/val_s32", EArmRelayWidth::Bit, 2, 1});
    CHECK(Parse("dob7") == ArmRelay{"dob7", "/project/plc/do/val_s32", EArmRelayWidth::Byte, 7, 0});
    CHECK(Parse("s0").url == "/project/plc/s/val_s32");
    CHECK(Parse("kb127").firstByte == 127);
}

TEST_CASE("A name that is no relay, or one that val_s32 does not show, is refused with the reason")
{
    for (const std::string_view name :
         {"",       "m",   "105",   "ml",     "ml5000", "m160000", "mb20000",    "mw10000",       "mf5",
          "si3",    "so3", "ML105", "ml105 ", "ml-1",   "ml1.5",   "fb10.m0",    "fn64.m0",       "fb.m0",
          "fbx.m0", ".m0", "fb0m0", "zz5",    "mll5",   "dil",     "fb0.fb0.m0", "ml99999999999", "di x1"})
    {
        INFO(name);
        const tl::expected<ArmRelay, std::string> relay = ParseArmRelay(name);
        REQUIRE_FALSE(relay.has_value());
        CHECK(relay.error().find("ml105") != std::string::npos);
    }
}

TEST_CASE("Where numbers count bytes, as the vendor's manual has it, wide relays may lie anywhere")
{
    const tl::expected<ArmRelay, std::string> relay = ParseArmRelay("mw501", EArmRelayIndex::Byte);
    REQUIRE(relay.has_value());
    CHECK(relay->firstByte == 501);
    CHECK(ParseArmRelay("ml420", EArmRelayIndex::Byte)->firstByte == Parse("ml105").firstByte);
    CHECK(ParseArmRelay("m3235", EArmRelayIndex::Byte)->firstByte == 404);
    CHECK(ParseArmRelay("ml19996", EArmRelayIndex::Byte).has_value());
    CHECK_FALSE(ParseArmRelay("ml19997", EArmRelayIndex::Byte).has_value());

    const ArmRelay spanning = *ParseArmRelay("ml402", EArmRelayIndex::Byte);
    const std::vector<ArmRelayRange> ranges = MakeRelayRanges({spanning});
    CHECK(ranges == std::vector<ArmRelayRange>{{"/project/plc/m/val_s32", 400, 2}});
    CHECK(ReadRelayOrNull(spanning, ranges.front(), {0x22'11'00'00, 0x00'00'44'33}) == 0x44'33'22'11);
    CHECK_FALSE(ReadRelayOrNull(spanning, ranges.front(), {0}).has_value());
}

TEST_CASE("A relay holds what its width holds, signed or unsigned")
{
    CHECK(CanHold(Parse("m5"), 1));
    CHECK_FALSE(CanHold(Parse("m5"), 2));
    CHECK_FALSE(CanHold(Parse("m5"), -1));
    CHECK(CanHold(Parse("mb5"), 255));
    CHECK(CanHold(Parse("mb5"), -128));
    CHECK_FALSE(CanHold(Parse("mb5"), 256));
    CHECK_FALSE(CanHold(Parse("mb5"), -129));
    CHECK(CanHold(Parse("mw5"), 65'535));
    CHECK_FALSE(CanHold(Parse("mw5"), 65'536));
    CHECK(CanHold(Parse("ml5"), 2'147'483'647));
    CHECK_FALSE(CanHold(Parse("ml5"), 2'147'483'648));
}

TEST_CASE("Relays that share a bit overlap")
{
    CHECK(IsOverlapping(Parse("ml105"), Parse("mb423")));
    CHECK(IsOverlapping(Parse("mb423"), Parse("ml105")));
    CHECK(IsOverlapping(Parse("m3360"), Parse("ml105")));
    CHECK_FALSE(IsOverlapping(Parse("ml105"), Parse("mb424")));
    CHECK_FALSE(IsOverlapping(Parse("m8"), Parse("m9")));
    CHECK_FALSE(IsOverlapping(Parse("ml5"), Parse("sl5")));
    CHECK(IsOverlapping(*ParseArmRelay("ml105", EArmRelayIndex::Byte), *ParseArmRelay("ml106", EArmRelayIndex::Byte)));
}

TEST_CASE("Relays of one area that lie together are read at once, others apart")
{
    const std::vector<ArmRelay> relays{Parse("ml109"), Parse("ml105"), Parse("do3"), Parse("mb443"), Parse("ml1000")};
    CHECK(
        MakeRelayRanges(relays)
        == std::vector<ArmRelayRange>{
            {"/project/plc/do/val_s32", 0, 1},
            {"/project/plc/m/val_s32", 420, 6},
            {"/project/plc/m/val_s32", 4000, 1}});
    CHECK(MakeRelayRanges({}).empty());
}

TEST_CASE("A value of any width is read out of the words of its range")
{
    const ArmRelayRange range{"/project/plc/m/val_s32", 400, 2};
    const std::vector<std::int64_t> words{-2, 0x12'34'F6'78};
    CHECK(ReadRelayOrNull(Parse("ml100"), range, words) == -2);
    CHECK(ReadRelayOrNull(Parse("ml101"), range, words) == 0x12'34'F6'78);
    CHECK(ReadRelayOrNull(Parse("mw202"), range, words) == -2440);
    CHECK(ReadRelayOrNull(Parse("mw203"), range, words) == 0x1234);
    CHECK(ReadRelayOrNull(Parse("mb405"), range, words) == -10);
    CHECK(ReadRelayOrNull(Parse("mb407"), range, words) == 0x12);
    CHECK(ReadRelayOrNull(Parse("m3235"), range, words) == 1); // byte 404, bit 3
    CHECK(ReadRelayOrNull(Parse("m3234"), range, words) == 0);
    CHECK_FALSE(ReadRelayOrNull(Parse("ml102"), range, words).has_value());
    CHECK_FALSE(ReadRelayOrNull(Parse("ml99"), range, words).has_value());
    CHECK_FALSE(ReadRelayOrNull(Parse("rl20"), range, words).has_value());
}

TEST_CASE("A value that was meant unsigned reads back as the same")
{
    CHECK(IsSameValue(Parse("mb5"), 200, -56));
    CHECK(IsSameValue(Parse("mw5"), 65'535, -1));
    CHECK(IsSameValue(Parse("ml5"), -7, -7));
    CHECK(IsSameValue(Parse("m5"), 1, 1));
    CHECK_FALSE(IsSameValue(Parse("mb5"), 200, 200 - 255));
    CHECK_FALSE(IsSameValue(Parse("ml5"), 7, -7));
    CHECK_FALSE(IsSameValue(Parse("m5"), 1, 0));
}

} // namespace ACS::Acsd::Test
