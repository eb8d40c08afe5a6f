# For systems that are not Debian 12. In the folder of the sources:
#   docker build --tag sonoglide .
#   docker run --rm --volume "$PWD:/sonoglide" --user "$(id --user):$(id --group)" sonoglide tools/demo
FROM debian:12
COPY tools/setup /tmp/tools/setup
RUN bash /tmp/tools/setup test && rm -rf /tmp/tools /var/lib/apt/lists/*
WORKDIR /sonoglide
ENV HOME=/tmp
