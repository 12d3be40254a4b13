#include "CertificateMaker.hpp"
#include "PostgresPlace.hpp"
#include "TemporaryFolder.hpp"

#include <chrono>
#include <string>

using namespace ACS::Planning;       // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Planning::Test; // NOLINT(google-build-using-namespace)
using namespace ACS;                 // NOLINT(google-build-using-namespace)

namespace
{

/// Why a store cannot be opened.
std::string Explain(const std::string& url)
{
    const Core::Result<LeaseState> state = PostgresLease({url, {}, std::chrono::seconds(5)}).Read();
    REQUIRE_FALSE(state.has_value());
    return Core::Describe(state.error());
}

} // namespace

TEST_CASE("PostgreSQL: a URL is read without its password")
{
    const PostgresTarget target =
        *ReadPostgresURL("postgresql://kim:secret@db1.plant,db2.plant:5433/acs?sslmode=require");
    CHECK(target.name == "postgresql://kim@db1.plant,db2.plant:5433/acs");
    REQUIRE(target.hosts.size() == 2);
    CHECK(target.hosts.front().port.empty());
    CHECK(target.hosts.back().host == "db2.plant");
    CHECK(ReadPostgresURL("postgresql://db1,db2/acs?port=5433")->name == "postgresql://db1:5433,db2:5433/acs");
    CHECK(ReadPostgresURL("postgresql://kim:pa?ss@db.plant/acs")->name == "postgresql://kim@db.plant/acs");
    CHECK(ReadPostgresURL("postgresql://kim:s%2Fecret@db.plant/acs")->name == "postgresql://kim@db.plant/acs");
    CHECK(ReadPostgresURL("postgresql://kim@[fd00::5]:5433/acs")->name == "postgresql://kim@[fd00::5]:5433/acs");
    CHECK_FALSE(ReadPostgresURL("postgresql:///acs?host=@socket")->bOtherMachine);
    const PostgresTarget both = *ReadPostgresURL("postgresql://a.plant,b.plant/acs?hostaddr=10.0.0.5,10.0.0.6");
    CHECK(both.name == "postgresql://a.plant,b.plant/acs");
    CHECK(both.hosts.back().address == "10.0.0.6");
    CHECK(ReadPostgresURL("postgresql:///acs?hostaddr=10.0.0.5")->name == "postgresql://10.0.0.5/acs");
    CHECK(target.bPassword);
    CHECK(target.bOtherMachine);
    CHECK_FALSE(target.bVerified);
    CHECK(ReadPostgresURL("postgresql://db1.plant/acs")->bVerified); // by default
    CHECK_FALSE(ReadPostgresURL("postgresql:///acs?host=/run/postgresql")->bOtherMachine);
    CHECK_FALSE(ReadPostgresURL("postgresql://localhost/acs")->bOtherMachine);
    CHECK(ReadPostgresURL("postgresql://127.0.0.1,db2.plant/acs")->bOtherMachine);
    for (const std::string url :
         {"mysql://kim:secret@db/acs",
          "postgresql://kim:secret@db:x/acs",
          "postgresql://kim:secret@[db/acs",
          "",
          "dbname=acs password=secret",
          "postgresql://kim:secret@db/acs?odd=1",
          "postgresql://kim:100%secret@db/acs",
          "postgresql://kim:pa@secret@db/acs",
          "postgresql://kim:secret/x@db/acs",
          "postgresql://kim:12/secret@db/acs"})
    {
        INFO(url);
        const Core::Result<PostgresTarget> refused = ReadPostgresURL(url);
        REQUIRE_FALSE(refused.has_value());
        CHECK_THAT(Core::Describe(refused.error()), !Catch::Contains("secret"));
    }
}

TEST_CASE("PostgreSQL: each reason why it cannot be used has its remedy")
{
    const PostgresPlace place;
    const std::string port = std::to_string(GetServer().GetPort());
    CHECK_THAT(Explain("postgresql://acsd@127.0.0.1:1/acs"), Catch::Contains("a database server that can be reached"));
    CHECK_THAT(Explain("postgresql://acsd@127.0.0.1:" + port + "/absent"), Catch::Contains("a database of this name"));
    CHECK_THAT(Explain("postgresql://acsd@db.invalid/acs"), Catch::Contains("the host name db.invalid has no address"));
    for (const std::string& host : {"localhost:" + port, "127.0.0.1:1,localhost:" + port})
    {
        CHECK(PostgresLease({"postgresql://acsd@" + host + "/" + place.GetDatabase(), {}, std::chrono::seconds(5)})
                  .Read()
                  .has_value());
    }
    const std::string addresses = "?hostaddr=127.0.0.1,127.0.0.1&port=1," + port;
    CHECK(PostgresLease(
              {"postgresql://acsd@a.invalid,b.invalid/" + place.GetDatabase() + addresses, {}, std::chrono::seconds(5)})
              .Read()
              .has_value());
    GetServer().Execute("DROP SCHEMA acsd CASCADE", place.GetDatabase());
    CHECK_THAT(
        Explain("postgresql://absent@127.0.0.1:" + port + "/postgres"),
        Catch::Contains("the right user and password"));

    GetServer().Execute("CREATE ROLE reader LOGIN");
    const std::string reader = "postgresql://reader@127.0.0.1:" + port + "/" + place.GetDatabase();
    CHECK_THAT(Explain(reader), Catch::Contains("a role that may create the schema acsd"));
    PostgresLease lease({reader, {}, std::chrono::seconds(5)});
    for (int call = 0; call < 2; ++call) // each call has the same reason
    {
        const Core::Result<LeaseState> state = lease.Read();
        REQUIRE_FALSE(state.has_value());
        CHECK_THAT(Core::Describe(state.error()), Catch::Contains("a role that may create the schema acsd"));
    }
    GetServer().Execute("ALTER ROLE reader SET default_transaction_read_only TO on");
    CHECK_THAT(Explain(reader), Catch::Contains("a server that accepts writes"));
    GetServer().Execute("ALTER ROLE reader RESET default_transaction_read_only");
    static_cast<void>(place.OpenLease());
    CHECK_THAT(Explain(reader), Catch::Contains("permission denied")); // it may not read the tables either
    place.Execute(
        "GRANT USAGE ON SCHEMA acsd TO reader; GRANT SELECT, UPDATE, DELETE ON ALL TABLES IN SCHEMA acsd TO reader; "
        "GRANT INSERT ON ALL TABLES IN SCHEMA acsd TO reader; REVOKE INSERT ON plans, reports FROM reader");
    CHECK_THAT(Explain(reader), Catch::Contains("a role that may not write plans, reports"));
    place.Execute("GRANT INSERT ON plans, reports TO reader");
    CHECK(PostgresLease({reader, {}, std::chrono::seconds(5)}).Read().has_value());

    GetServer().Execute("ALTER ROLE reader SET idle_session_timeout TO '50ms'");
    PostgresLease idle({reader, {}, std::chrono::seconds(5)});
    REQUIRE(idle.Read().has_value());
    GetServer().Execute("SELECT pg_sleep(0.2)");
    CHECK(idle.Read().has_value()); // acsd overrides limits that a role or a database has
    GetServer().Execute("CREATE DATABASE latin ENCODING 'LATIN1' TEMPLATE template0");
    CHECK_THAT(Explain(GetServer().GetURL("latin")), Catch::Contains("the encoding UTF8"));
    CHECK_THAT(Explain("postgresql://acsd@127.0.0.1:" + port + "/postgres?sslmode=require"), Catch::Contains("SSL"));
}

TEST_CASE("PostgreSQL: the server is identified by its certificate")
{
    const Testing::TemporaryFolder folder;
    Testing::CertificateMaker maker(folder.GetPath());
    const Testing::CertificateFiles ca = maker.MakeCA("ca");
    const Testing::CertificateFiles other = maker.MakeCA("other");
    const Testing::CertificateFiles certificate = maker.Make(ca, {});
    Testing::PostgresServer::GiveToServer(folder.GetPath().string());
    const Testing::PostgresServer server(
        {"ssl=on", "ssl_cert_file=" + certificate.certificate, "ssl_key_file=" + certificate.key});
    const auto read = [&server](const std::string& parameters) {
        const PostgresOptions options{server.GetURL() + "?" + parameters, {}, std::chrono::seconds(5)};
        const Core::Result<LeaseState> state = PostgresLease(options).Read();
        return state.has_value() ? std::string("connected") : Core::Describe(state.error());
    };
    CHECK(read("sslmode=verify-full&sslrootcert=" + ca.certificate) == "connected");
    CHECK_THAT(
        read("sslmode=verify-full&sslrootcert=" + other.certificate),
        Catch::Contains("give its issuer as sslrootcert"));
    CHECK_THAT(
        read("sslmode=verify-full&sslrootcert=" + folder.GetPath().string() + "/absent"),
        Catch::Contains("certificate"));
}
