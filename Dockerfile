# For systems that are not Debian 12. In the folder of the sources:
#   docker build --tag sonoglide .
#   docker run --rm --volume "$PWD:/sonoglide" --user "$(id --user):$(id --group)" sonoglide tools/demo
FROM debian:12
WORKDIR /sonoglide
COPY tools/setup tools/setup
RUN bash tools/setup test && rm -rf /var/lib/apt/lists/*
ENV XDG_CACHE_HOME=/sonoglide/build/cache
