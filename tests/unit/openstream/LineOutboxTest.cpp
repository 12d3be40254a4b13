#include "LineOutbox.hpp"

#include "Catch.hpp"

#include <string>

using ACS::OpenStream::LineOutbox;

TEST_CASE("7.26 A data line that is not yet sent is replaced by a newer one, one in flight is not")
{
    LineOutbox outbox(100);
    bool bReplaced = false;
    outbox.BeginData(bReplaced) = "d1\n";
    REQUIRE_FALSE(bReplaced);
    REQUIRE(outbox.TakeForSend() == "d1\n");
    outbox.BeginData(bReplaced) = "d2\n";
    REQUIRE_FALSE(bReplaced);
    outbox.BeginData(bReplaced) = "d3\n";
    REQUIRE(bReplaced);
    REQUIRE(outbox.TakeForSend().empty());
    REQUIRE(outbox.CompleteSend() == 1);
    REQUIRE(outbox.TakeForSend() == "d3\n");
}

TEST_CASE("7.22 Lines appended after a sealed data line are sent after it")
{
    LineOutbox outbox(100);
    bool bReplaced = false;
    outbox.BeginData(bReplaced) = "d1\n";
    outbox.SealData();
    outbox.GetLines() += "ack\n";
    outbox.BeginData(bReplaced) = "d2\n";
    REQUIRE_FALSE(bReplaced);
    REQUIRE(outbox.TakeForSend() == "d1\nack\nd2\n");
    REQUIRE(outbox.CompleteSend() == 2);
}

TEST_CASE("8 Lines are limited, and a mark reports when they are sent")
{
    LineOutbox outbox(4);
    outbox.GetLines() += "one\n";
    const std::uint64_t first = outbox.GetMark();
    REQUIRE_FALSE(outbox.WasTaken(first));
    REQUIRE(outbox.TakeForSend() == "one\n");
    outbox.GetLines() += "three\n";
    REQUIRE(outbox.IsFull());
    const std::uint64_t second = outbox.GetMark();
    REQUIRE(outbox.WasTaken(first));
    REQUIRE_FALSE(outbox.WasSent(first));
    REQUIRE(outbox.CompleteSend() == 0);
    REQUIRE(outbox.WasSent(first));
    REQUIRE_FALSE(outbox.WasTaken(second));
}
