#include "LineOutbox.hpp"

#include "Catch.hpp"

#include <string>

using ACS::OpenStream::LineOutbox;

TEST_CASE("7.26 A data line that has not left gives way to the newer one, one in flight does not")
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

TEST_CASE("7.22 What is appended behind a sealed data line leaves behind it")
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

TEST_CASE("8 Lines are bounded, and a mark tells when they have left")
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
