// needs: PostgreSQL
#include <acs/plan_postgres/PostgresLease.hpp>
#include <acs/plan_postgres/PostgresPlanStore.hpp>

#include <cstdio>

int main()
{
    const auto lease = ACS::Planning::PostgresLease({"postgresql://acs@127.0.0.1:1/none", {}}).Read();
    const std::string sentence = lease.has_value() ? std::string() : ACS::Core::Describe(lease.error());
    std::puts(sentence.c_str());
    return sentence.find("postgresql://acs@127.0.0.1:1/none") == std::string::npos ? 1 : 0;
}
