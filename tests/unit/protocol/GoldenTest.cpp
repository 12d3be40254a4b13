#include "Catch.hpp"
#include "GoldenFiles.hpp"
#include <acs/protocol/AcsCodec.hpp>

#include <cstddef>
#include <set>
#include <string>
#include <vector>

using namespace ACS; // NOLINT(google-build-using-namespace)
using Protocol::AcsCodec;
using Protocol::AcsMessage;
using Protocol::DecodeOutcome;
using Protocol::EAcsCommand;

namespace
{

/// A request or a response of the protocol.
struct Kind
{
    EAcsCommand command = EAcsCommand::ExecutionPlan;
    bool bAck = false;
    std::string name;
};

/// Every message of the protocol, in both directions.
std::vector<Kind> ListKinds()
{
    std::vector<Kind> kinds;
    for (std::size_t index = 0; index < Protocol::COMMAND_COUNT; ++index)
    {
        const auto command = static_cast<EAcsCommand>(index);
        const std::string name(GetText(command));
        kinds.push_back({command, false, name});
        if (HasAck(command))
        {
            kinds.push_back({command, true, name + "Ack"});
        }
    }
    return kinds;
}

std::string ReadGolden(const Kind& kind, const std::string& variant)
{
    return Testing::ReadGolden(ACS_FIXTURES "/golden", kind.name + "." + variant + ".json");
}

AcsMessage Decode(AcsCodec& codec, const std::string& text)
{
    DecodeOutcome outcome = codec.Decode(text);
    INFO(text);
    if (!outcome.message.has_value())
    {
        FAIL(Core::Describe(outcome.message.error().error));
    }
    return std::move(*outcome.message);
}

std::string Encode(const AcsMessage& message)
{
    std::string text;
    AcsCodec::Encode(message, text);
    return text;
}

void CheckKind(const Kind& kind, const AcsMessage& message)
{
    REQUIRE(std::holds_alternative<Protocol::AcsAck>(message) == kind.bAck);
    const EAcsCommand command =
        kind.bAck ? std::get<Protocol::AcsAck>(message).command : GetCommand(std::get<Protocol::AcsRequest>(message));
    CHECK(command == kind.command);
}

} // namespace

TEST_CASE("4, 5 Every message, full and minimal, decodes and encodes to the same bytes")
{
    AcsCodec codec;
    for (const Kind& kind : ListKinds())
    {
        for (const std::string variant : {"full", "minimal"})
        {
            INFO(kind.name << " " << variant);
            const std::string text = ReadGolden(kind, variant);
            CHECK(codec.Decode(text).notes == Protocol::DecodeNotes{});
            const AcsMessage message = Decode(codec, text);
            CheckKind(kind, message);
            CHECK(Encode(message) == text);
        }
        CHECK_FALSE(Decode(codec, ReadGolden(kind, "full")) == Decode(codec, ReadGolden(kind, "minimal")));
    }
}

TEST_CASE("2, D-27 With null or nothing in every optional member a message is the minimal one")
{
    AcsCodec codec;
    for (const Kind& kind : ListKinds())
    {
        // The contents of SyncConfig are not decoded.
        if (kind.command == EAcsCommand::SyncConfig && !kind.bAck)
        {
            CHECK(Encode(Decode(codec, ReadGolden(kind, "null"))).find(R"("payload":{"x":null})") != std::string::npos);
            continue;
        }
        INFO(kind.name);
        const std::string text = ReadGolden(kind, "null");
        const std::string minimal = ReadGolden(kind, "minimal");
        CHECK(text.find("null") != std::string::npos);
        CHECK(Encode(Decode(codec, text)) == minimal);
        const std::string bare = Testing::DropNullMembers(text);
        CHECK(bare.find("null") == std::string::npos);
        CHECK(codec.Decode(bare).notes == Protocol::DecodeNotes{});
        CHECK(Encode(Decode(codec, bare)) == minimal);
    }
}

TEST_CASE("4, 5 There is a golden file of each kind for every message, and no other")
{
    std::set<std::string> expected;
    for (const Kind& kind : ListKinds())
    {
        for (const std::string variant : {"full", "minimal", "null"})
        {
            expected.insert(kind.name + "." + variant + ".json");
        }
    }
    CHECK(Testing::ListGolden(ACS_FIXTURES "/golden") == expected);
}
