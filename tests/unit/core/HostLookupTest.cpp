#include "Catch.hpp"
#include <acs/net/HostLookup.hpp>

#include <boost/asio/io_context.hpp>

#include <memory>
#include <string>
#include <vector>

namespace ACS::Testing
{

namespace
{

struct LookupFixture
{
    boost::asio::io_context context;
    std::unique_ptr<Net::HostLookup> lookup = std::make_unique<Net::HostLookup>(context.get_executor());
    std::vector<std::string> found;
    std::vector<boost::system::error_code> errors;

    void Resolve(const std::string& host)
    {
        lookup->ResolveAsync(host, "7000", [this](const auto& error, const Net::HostLookup::Addresses& addresses) {
            errors.push_back(error);
            for (const auto& entry : addresses)
            {
                found.push_back(entry.endpoint().address().to_string());
                CHECK(entry.endpoint().port() == 7000);
            }
        });
    }
};

} // namespace

TEST_CASE_METHOD(LookupFixture, "A numeric address is found in the next turn of the loop, without a name server")
{
    Resolve("192.0.2.7");
    CHECK(errors.empty());
    CHECK(context.poll() == 1);
    Resolve("2001:db8::7");
    context.restart();
    CHECK(context.poll() == 1);
    CHECK(found == std::vector<std::string>{"192.0.2.7", "2001:db8::7"});
    CHECK(errors == std::vector<boost::system::error_code>(2));
}

TEST_CASE_METHOD(LookupFixture, "A name is found by a thread, and the loop has work until then")
{
    Resolve("localhost");
    context.run();
    REQUIRE(errors.size() == 1);
    CHECK_FALSE(errors.front().failed());
    CHECK_FALSE(found.empty());
}

TEST_CASE_METHOD(LookupFixture, "A name that does not exist is an error")
{
    Resolve("name with blanks");
    context.run();
    REQUIRE(errors.size() == 1);
    CHECK(errors.front().failed());
}

TEST_CASE_METHOD(LookupFixture, "A cancelled question is answered once, and the next one has an answer of its own")
{
    Resolve("localhost");
    lookup->Cancel();
    lookup->Cancel();
    Resolve("localhost");
    context.run();
    REQUIRE(errors.size() == 2);
    CHECK_FALSE(errors.back().failed());
    Resolve("localhost");
    Resolve("192.0.2.7"); // cancels the one before
    context.restart();
    context.run();
    CHECK(errors.size() == 4);
    CHECK(found.back() == "192.0.2.7");
}

TEST_CASE_METHOD(LookupFixture, "After its end nothing is called, and the loop has no work")
{
    Resolve("localhost");
    lookup.reset();
    context.run();
    CHECK(errors.empty());
}

} // namespace ACS::Testing
