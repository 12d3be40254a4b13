#!/bin/bash
# Executed once by the image of PostgreSQL, when its volume is empty: the role of acsd and its database. The role owns the database
# and is no superuser.
set -euo pipefail
psql --no-psqlrc --set=ON_ERROR_STOP=1 --set=password="$(cat "${ACSD_PASSWORD_FILE:-/etc/postgres/acsd-password}")" \
    --username="${POSTGRES_USER:-postgres}" --dbname=postgres <<'SQL'
SET password_encryption TO 'scram-sha-256';
CREATE ROLE acsd LOGIN PASSWORD :'password';
CREATE DATABASE acs OWNER acsd ENCODING 'UTF8' TEMPLATE template0;
SQL
